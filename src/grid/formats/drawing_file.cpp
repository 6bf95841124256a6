#include "grid/formats/drawing_file.h"

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <locale>
#include <sstream>
#include <vector>

#include "grid/formats/drawn_shapes.h"
#include "grid/formats/map_warning.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/yaml_file.h"
#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

using base::decimalText, base::describeYaml, base::InputError, base::ReadLimits, base::yamlAs,
    base::yamlError, base::yamlNode, base::yamlValue;

namespace {

using Eigen::Vector2d;

constexpr const char* kLength = "a positive, finite number of metres";
constexpr const char* kPoint = "a list of x and y in metres";

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

double coordinateOf(const YAML::Node& node, const std::string& name, const std::string& file) {
  constexpr double kFarthest = 1e9;
  const auto metres = yamlAs<double>(node, name, file, "a number of metres");
  if (std::abs(metres) <= kFarthest) return metres;
  throw yamlError(
      node, file,
      name + " must be a number of metres within 1e9 m of 0, got " + decimalText(metres));
}

Vector2d pointOf(const YAML::Node& node, const std::string& name, const std::string& file) {
  if (!node.IsSequence() || node.size() != 2)
    throw yamlError(node, file, name + " must be " + kPoint + ", got " + counted(node));
  return {coordinateOf(node[0], name, file), coordinateOf(node[1], name, file)};
}

// Draws one obstacle after the other. Few letters may name many, by YAML's aliases.
class ObstacleReader {
 public:
  ObstacleReader(OccupancyGrid& map, double resolution, const std::string& file, ReadLimits& limits)
      : file_(file),
        limits_(limits),
        canvas_(map, resolution, file, limits),
        diagonal_(std::sqrt(2.0) * resolution) {}

  void draw(const YAML::Node& node) {
    constexpr const char* kShape = "one of polygon, circle and wall";
    limits_.goOn(file_);
    if (!node.IsMap() || node.size() != 1)
      throw yamlError(
          node, file_,
          std::string("an obstacle must be ") + kShape + ", got " +
              (node.IsMap() ? std::to_string(node.size()) + " entries" : describeYaml(node)));
    if (node["polygon"]) return canvas_.drawPolygon(pointsOf(node["polygon"], "polygon", 3));
    if (node["circle"]) return drawCircle(node["circle"]);
    if (node["wall"]) return drawWall(node["wall"]);
    throw yamlError(node, file_,
                    std::string("an obstacle must be ") + kShape + ", got " +
                        describeYaml(node.begin()->first));
  }

  // How many walls and circles may have gaps.
  std::size_t thin() const { return thin_; }

 private:
  std::vector<Vector2d> pointsOf(const YAML::Node& node, const char* name, std::size_t fewest) {
    if (!node.IsSequence() || node.size() < fewest)
      throw yamlError(node, file_,
                      std::string(name) + " must be a list of at least " + std::to_string(fewest) +
                          " points, got " + counted(node));
    limits_.check(file_, node.size() * sizeof(Vector2d));
    base::ReadPoll poll(limits_, file_, kPointsBetweenQuestions);
    std::vector<Vector2d> points;
    points.reserve(node.size());
    for (const YAML::Node& point : node) {
      poll();
      points.push_back(pointOf(point, name, file_));
    }
    return points;
  }

  void drawCircle(const YAML::Node& node) {
    const Vector2d centre = pointOf(yamlNode(node, "centre", file_, kPoint), "centre", file_);
    const double radius = lengthOf(node, "radius", file_);
    countThin(2.0 * radius);
    canvas_.drawCircle(centre, radius);
  }

  void drawWall(const YAML::Node& node) {
    const std::vector<Vector2d> points =
        pointsOf(yamlNode(node, "points", file_, "a list of points"), "points", 2);
    const double thickness = lengthOf(node, "thickness", file_);
    countThin(thickness);
    canvas_.drawWall(points, thickness / 2.0);
  }

  void countThin(double thickness) { thin_ += thickness < diagonal_ ? 1 : 0; }

  static constexpr std::uint32_t kPointsBetweenQuestions = 16;

  const std::string& file_;
  ReadLimits& limits_;
  Canvas canvas_;
  const double diagonal_;
  std::size_t thin_ = 0;
};

void checkKeys(const YAML::Node& drawing, const std::string& file) {
  if (!drawing.IsMap()) return;  // told by whoever looks for a key
  for (const auto& entry : drawing) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (key != "size" && key != "resolution" && key != "obstacles")
      throw yamlError(
          entry.first, file,
          "a vector_map has size, resolution and obstacles, got " + describeYaml(entry.first));
  }
}

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

}  // namespace

bool looksLikeVectorMap(const YAML::Node& root) {
  return root.IsMap() && root["vector_map"];
}

OccupancyGrid readVectorMap(const YAML::Node& root, const std::string& file,
                            MapFileOptions& options) {
  const YAML::Node drawing = root["vector_map"];
  checkKeys(drawing, file);
  const Vector2d size = pointOf(
      yamlNode(drawing, "size", file, "a list of width and height in metres"), "size", file);
  const double resolution =
      options.resolution ? *options.resolution : lengthOf(drawing, "resolution", file);
  const YAML::Node obstacles = yamlNode(drawing, "obstacles", file, "a list of obstacles");
  if (!obstacles.IsSequence())
    throw yamlError(obstacles, file, "obstacles must be a list, got " + describeYaml(obstacles));
  const GridGeometry geometry =
      mapGeometry(file, cellsAlong(size.x(), resolution, file),
                  cellsAlong(size.y(), resolution, file), resolution, {}, options);
  options.limits.take(file, geometry.size());
  OccupancyGrid map(geometry, 0);
  ObstacleReader reader(map, resolution, file, options.limits);
  for (const YAML::Node& node : obstacles) reader.draw(node);
  if (reader.thin() > 0)
    warnAbout(file,
              std::to_string(reader.thin()) +
                  " of its walls and circles are thinner than the diagonal of a "
                  "cell of " +
                  metres(resolution) + " and may have gaps or be missing: use a finer resolution",
              options);
  return map;
}

}  // namespace grid_path_planner::grid
