#include "grid/formats/drawing_file.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>
#include <vector>

#include "grid/formats/map_warning.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/yaml_file.h"
#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

using base::decimalText, base::describeYaml, base::InputError, base::yamlAs, base::yamlError,
    base::yamlNode, base::yamlValue;

namespace {

using Eigen::Vector2d;

constexpr const char* kLength = "a positive, finite number of metres";
constexpr const char* kPoint = "a list of x and y in metres";

struct Obstacle {
  Vector2d low, high;  // holds all of it, m
  double thickness;    // of a part that must not have gaps, m
  std::function<bool(const Vector2d&)> contains;
};

double crossProduct(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double distanceToSegment(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  const Vector2d along = to - from;
  const double length = along.squaredNorm();
  const double share =
      length > 0.0 ? std::clamp((point - from).dot(along) / length, 0.0, 1.0) : 0.0;
  return (point - from - share * along).norm();
}

bool onSegment(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  return crossProduct(to - from, point - from) == 0.0 && (point - from).dot(point - to) <= 0.0;
}

// Even-odd, the rim included.
bool polygonContains(const std::vector<Vector2d>& corners, const Vector2d& point) {
  bool inside = false;
  for (std::size_t i = 0, before = corners.size() - 1; i < corners.size(); before = i++) {
    const Vector2d &a = corners[before], &b = corners[i];
    if (onSegment(point, a, b)) return true;
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double side = crossProduct(b - a, point - a);
    if ((b.y() > a.y()) == (side > 0.0)) inside = !inside;
  }
  return inside;
}

Obstacle around(const std::vector<Vector2d>& points, double reach,
                std::function<bool(const Vector2d&)> contains) {
  const double thickness = reach > 0.0 ? 2.0 * reach : std::numeric_limits<double>::infinity();
  Obstacle obstacle{points.front(), points.front(), thickness, std::move(contains)};
  for (const Vector2d& point : points) {
    obstacle.low = obstacle.low.cwiseMin(point);
    obstacle.high = obstacle.high.cwiseMax(point);
  }
  obstacle.low.array() -= reach;
  obstacle.high.array() += reach;
  return obstacle;
}

// ---- reading

double lengthOf(const YAML::Node& parent, const char* key, const std::string& file) {
  const auto length = yamlValue<double>(parent, key, file, kLength);
  if (!(length > 0.0))
    throw yamlError(parent[key], file,
                    std::string(key) + " must be " + kLength + ", got " + decimalText(length));
  return length;
}

std::string counted(const YAML::Node& node) {
  return node.IsSequence() ? "a list of " + std::to_string(node.size()) : describeYaml(node);
}

Vector2d pointOf(const YAML::Node& node, const std::string& name, const std::string& file) {
  if (!node.IsSequence() || node.size() != 2)
    throw yamlError(node, file, name + " must be " + kPoint + ", got " + counted(node));
  return {yamlAs<double>(node[0], name, file, "a number of metres"),
          yamlAs<double>(node[1], name, file, "a number of metres")};
}

std::vector<Vector2d> pointsOf(const YAML::Node& node, const char* name, std::size_t fewest,
                               const std::string& file) {
  if (!node.IsSequence() || node.size() < fewest)
    throw yamlError(node, file,
                    std::string(name) + " must be a list of at least " + std::to_string(fewest) +
                        " points, got " + counted(node));
  std::vector<Vector2d> points;
  for (const YAML::Node& point : node) points.push_back(pointOf(point, name, file));
  return points;
}

Obstacle readPolygon(const YAML::Node& node, const std::string& file) {
  const std::vector<Vector2d> corners = pointsOf(node, "polygon", 3, file);
  return around(corners, 0.0,
                [corners](const Vector2d& point) { return polygonContains(corners, point); });
}

Obstacle readCircle(const YAML::Node& node, const std::string& file) {
  const Vector2d centre = pointOf(yamlNode(node, "centre", file, kPoint), "centre", file);
  const double radius = lengthOf(node, "radius", file);
  return around({centre}, radius, [centre, radius](const Vector2d& point) {
    return (point - centre).norm() <= radius;
  });
}

Obstacle readWall(const YAML::Node& node, const std::string& file) {
  const std::vector<Vector2d> points =
      pointsOf(yamlNode(node, "points", file, "a list of points"), "points", 2, file);
  const double reach = lengthOf(node, "thickness", file) / 2.0;
  return around(points, reach, [points, reach](const Vector2d& point) {
    for (std::size_t i = 1; i < points.size(); ++i)
      if (distanceToSegment(point, points[i - 1], points[i]) <= reach) return true;
    return false;
  });
}

void checkKeys(const YAML::Node& drawing, const std::string& file) {
  if (!drawing.IsMap()) return;  // told by whoever looks for a key
  for (const auto& entry : drawing) {
    const auto key = entry.first.as<std::string>();
    if (key != "size" && key != "resolution" && key != "obstacles")
      throw yamlError(entry.first, file,
                      "a vector_map has size, resolution and obstacles, got '" + key + "'");
  }
}

Obstacle readObstacle(const YAML::Node& node, const std::string& file) {
  constexpr const char* kShape = "one of polygon, circle and wall";
  if (!node.IsMap() || node.size() != 1)
    throw yamlError(
        node, file,
        std::string("an obstacle must be ") + kShape + ", got " +
            (node.IsMap() ? std::to_string(node.size()) + " entries" : describeYaml(node)));
  if (node["polygon"]) return readPolygon(node["polygon"], file);
  if (node["circle"]) return readCircle(node["circle"], file);
  if (node["wall"]) return readWall(node["wall"], file);
  throw yamlError(node, file,
                  std::string("an obstacle must be ") + kShape + ", got '" +
                      node.begin()->first.as<std::string>() + "'");
}

// ---- drawing

std::string metres(double length) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << length << " m";
  return out.str();
}

int cellsAlong(double length, double resolution, const std::string& file) {
  const double cells = std::round(length / resolution);
  if (!(cells >= 1.0 && cells <= 1e9))
    throw InputError(file, metres(length) + " do not make a map of cells of " + metres(resolution));
  return static_cast<int>(cells);
}

// The cell along an axis that holds `metres`, at least 0 and at most `most`.
int cellHolding(double metres, double resolution, int most) {
  return static_cast<int>(std::clamp(std::floor(metres / resolution), 0.0, double(most)));
}

void draw(const Obstacle& obstacle, double resolution, OccupancyGrid& map) {
  const int first_column = cellHolding(obstacle.low.x(), resolution, map.width());
  const int last_column = cellHolding(obstacle.high.x(), resolution, map.width() - 1);
  const int last_row = cellHolding(obstacle.high.y(), resolution, map.height() - 1);
  for (int row = cellHolding(obstacle.low.y(), resolution, map.height()); row <= last_row; ++row)
    for (int column = first_column; column <= last_column; ++column)
      if (obstacle.contains(resolution * Vector2d(column + 0.5, row + 0.5)))
        map[{column, row}] = 100;
}

}  // namespace

bool looksLikeVectorMap(const YAML::Node& root) {
  return root.IsMap() && root["vector_map"];
}

OccupancyGrid readVectorMap(const YAML::Node& root, const std::string& file,
                            const MapFileOptions& options) {
  const YAML::Node drawing = root["vector_map"];
  checkKeys(drawing, file);
  const Vector2d size = pointOf(
      yamlNode(drawing, "size", file, "a list of width and height in metres"), "size", file);
  const double resolution =
      options.resolution ? *options.resolution : lengthOf(drawing, "resolution", file);
  const YAML::Node obstacles = yamlNode(drawing, "obstacles", file, "a list of obstacles");
  if (!obstacles.IsSequence())
    throw yamlError(obstacles, file, "obstacles must be a list, got " + describeYaml(obstacles));
  OccupancyGrid map(mapGeometry(file, cellsAlong(size.x(), resolution, file),
                                cellsAlong(size.y(), resolution, file), resolution, {}, options),
                    0);
  std::size_t thin = 0;
  for (const YAML::Node& node : obstacles) {
    const Obstacle obstacle = readObstacle(node, file);
    thin += obstacle.thickness < std::sqrt(2.0) * resolution ? 1 : 0;
    draw(obstacle, resolution, map);
  }
  if (thin > 0)
    warnAbout(file,
              std::to_string(thin) +
                  " of its walls and circles are thinner than the diagonal of a "
                  "cell of " +
                  metres(resolution) + " and may have gaps or be missing: use a finer resolution",
              options);
  return map;
}

}  // namespace grid_path_planner::grid
