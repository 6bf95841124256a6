#include "layers/zones.h"

#include <algorithm>
#include <cmath>

#include "grid/polygon_cover.h"
#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/yaml_file.h"
#include "layers/zone_cells.h"

namespace grid_path_planner::layers {

using base::checkKeys, base::decimalText, base::describeYaml, base::yamlAs, base::yamlError,
    base::yamlNode, base::yamlValue, base::yamlValueOr;
using Eigen::Vector2d;
using grid::OccupancyGrid;
using grid::RowSpan;

namespace {

constexpr double kFarthest = 1e6;           // m
constexpr double kFastest = 1000.0;         // m/s
constexpr std::size_t kMostPoints = 10000;  // of all zones: each is drawn over the rows of a map
constexpr std::size_t kLongest = 256;       // bytes of a name
constexpr const char* kPoint = "a list of x and y in metres";

double coordinateOf(const YAML::Node& node, const std::string& file) {
  const auto metres = yamlAs<double>(node, "a coordinate", file, "a number of metres");
  if (std::abs(metres) > kFarthest)
    throw yamlError(node, file,
                    "a coordinate must be within 1e6 m of 0, got " + decimalText(metres));
  return metres;
}

std::vector<Vector2d> polygonOf(const YAML::Node& zone, const std::string& file) {
  const YAML::Node list = yamlNode(zone, "polygon", file, "a list of points");
  if (!list.IsSequence() || list.size() < 3)
    throw yamlError(list, file,
                    "polygon must be a list of at least 3 points, got " +
                        (list.IsSequence() ? std::to_string(list.size()) : describeYaml(list)));
  std::vector<Vector2d> polygon;
  polygon.reserve(list.size());
  for (const YAML::Node& point : list) {
    if (!point.IsSequence() || point.size() != 2)
      throw yamlError(point, file,
                      std::string("a point must be ") + kPoint + ", got " + describeYaml(point));
    polygon.emplace_back(coordinateOf(point[0], file), coordinateOf(point[1], file));
  }
  return polygon;
}

Zone::Kind kindOf(const YAML::Node& zone, const std::string& file) {
  const auto kind = yamlValue<std::string>(zone, "kind", file, "keep_out or slow");
  if (kind == "keep_out") return Zone::Kind::KEEP_OUT;
  if (kind == "slow") return Zone::Kind::SLOW;
  throw yamlError(zone["kind"], file, "kind must be keep_out or slow, got '" + kind + "'");
}

double speedOf(const YAML::Node& zone, const std::string& file) {
  const auto speed = yamlValue<double>(zone, "max_speed", file, "a number of m/s");
  if (!(speed > 0.0 && speed <= kFastest))
    throw yamlError(zone["max_speed"], file,
                    "max_speed must be above 0 and at most 1000 m/s, got " + decimalText(speed));
  return speed;
}

Zone zoneOf(const YAML::Node& node, std::size_t number, const std::string& file) {
  checkKeys(node, "a zone", file, {"name", "kind", "max_speed", "polygon"});
  Zone zone;
  zone.name = yamlValueOr<std::string>(node, "name", file, "a name", std::to_string(number));
  if (zone.name.size() > kLongest)
    throw yamlError(node["name"], file, "the name of a zone has at most 256 bytes");
  zone.kind = kindOf(node, file);
  if (zone.kind == Zone::Kind::SLOW)
    zone.max_speed = speedOf(node, file);
  else if (node["max_speed"])
    throw yamlError(node["max_speed"], file, "a keep_out zone has no max_speed");
  zone.polygon = polygonOf(node, file);
  return zone;
}

}  // namespace

Zones readZones(const std::string& file, const base::ReadLimits& limits) {
  const YAML::Node root = base::loadYamlFile(file, limits);
  checkKeys(root, "a file of zones", file, {"frame_id", "zones"});
  Zones zones;
  zones.frame_id = yamlValueOr<std::string>(root, "frame_id", file, "the name of a frame", "");
  const YAML::Node list = yamlNode(root, "zones", file, "a list of zones");
  if (!list.IsSequence())
    throw yamlError(list, file, "zones must be a list, got " + describeYaml(list));
  std::size_t points = 0;
  for (const YAML::Node& node : list) {
    zones.zones.push_back(zoneOf(node, zones.zones.size() + 1, file));
    points += zones.zones.back().polygon.size();
    if (points > kMostPoints)
      throw yamlError(node, file, "the zones of a file have at most 10000 points together");
  }
  return zones;
}

std::vector<RowSpan> cellsOf(const Zone& zone, const grid::GridGeometry& geometry) {
  std::vector<Vector2d> corners;
  corners.reserve(zone.polygon.size());
  for (const Vector2d& point : zone.polygon) corners.push_back(geometry.gridFromWorld(point));
  return grid::touchedCells(corners, geometry.rect());
}

std::vector<std::string> drawKeepOutZones(const Zones& zones, OccupancyGrid& map) {
  std::vector<std::string> outside;
  for (const Zone& zone : zones.zones) {
    const std::vector<RowSpan> cells = cellsOf(zone, map.geometry());
    if (cells.empty()) outside.push_back(zone.name);
    if (zone.kind != Zone::Kind::KEEP_OUT) continue;
    for (const RowSpan& span : cells)
      std::fill(map.row(span.row) + span.first, map.row(span.row) + span.end, std::int8_t{100});
  }
  return outside;
}

}  // namespace grid_path_planner::layers
