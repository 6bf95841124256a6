#include <cmath>
#include <limits>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/yaml_file.h"
#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "path/waypoint_entry.h"
#include "path/waypoint_formats/waypoint_texts.h"

namespace grid_path_planner::path {

using base::decimalText, base::describeYaml, base::InputError, base::parseYaml, base::yamlAs,
    base::yamlError, base::yamlHas, base::yamlNode, base::yamlValue;

namespace {

constexpr double kHighest = 1e7;  // m
constexpr double kNoYaw = std::numeric_limits<double>::quiet_NaN();

// JSON is YAML too, and its parser knows the lines.
class GeojsonReading {
 public:
  GeojsonReading(const WaypointText& text, const Datum& datum)
      : file_(text.file), limits_(text.limits), plane_(datum) {}

  Path read(const YAML::Node& root) {
    if (yamlHas(root, "frame_id", file_)) takeFrame(root["frame_id"]);
    const std::string type = typeOf(root);
    if (type == "FeatureCollection")
      for (const YAML::Node& feature : listAt(root, "features")) takeFeature(feature);
    else if (type == "Feature")
      takeFeature(root);
    else
      takeGeometry(root, YAML::Node());
    if (path_.empty()) throw InputError(file_, "holds no waypoint");
    return path_;
  }

 private:
  std::string typeOf(const YAML::Node& node) const {
    return yamlValue<std::string>(node, "type", file_, "the type of a GeoJSON object");
  }

  YAML::Node listAt(const YAML::Node& node, const std::string& key) const {
    const YAML::Node list = yamlNode(node, key, file_, "a list");
    if (!list.IsSequence())
      throw yamlError(list, file_, key + " must be a list, got " + describeYaml(list));
    return list;
  }

  void takeFrame(const YAML::Node& node) {
    const auto frame =
        withoutSlash(yamlAs<std::string>(node, "frame_id", file_, "the name of a frame"));
    if (!isPlainFrame(frame)) throw yamlError(node, file_, "frame_id must be the name of a frame");
    path_.frame_id = frame;
  }

  void takeFeature(const YAML::Node& feature) {
    limits_.goOn(file_);
    if (typeOf(feature) != "Feature")
      throw yamlError(feature, file_, "the list of features must hold features alone");
    YAML::Node yaw;
    if (yamlHas(feature, "properties", file_) && feature["properties"].IsMap() &&
        feature["properties"]["yaw"])
      yaw = feature["properties"]["yaw"];
    takeGeometry(yamlNode(feature, "geometry", file_, "a geometry"), yaw);
  }

  void takeGeometry(const YAML::Node& geometry, const YAML::Node& yaw) {
    const std::string type = typeOf(geometry);
    const YAML::Node places = listAt(geometry, "coordinates");
    if (type == "Point") {
      takePosition(places, yaw.IsScalar() ? yawAt(yaw) : kNoYaw);
    } else if (type == "LineString" || type == "MultiPoint") {
      if (yaw.IsSequence() && yaw.size() != places.size())
        throw yamlError(yaw, file_, "yaw must have a number for each position");
      limits_.take(file_, places.size() * sizeof(Pose));
      for (std::size_t i = 0; i < places.size(); ++i)
        takePosition(places[i], yaw.IsSequence() ? yawAt(yaw[i]) : kNoYaw);
    } else {
      throw yamlError(
          geometry, file_,
          "waypoints are a Point, MultiPoint or LineString, got '" + type.substr(0, 80) + "'");
    }
  }

  double yawAt(const YAML::Node& node) const {
    const auto from_east = yamlAs<double>(node, "yaw", file_, "an angle in radians");
    return std::remainder(from_east - plane_.yaw(), 2.0 * M_PI);
  }

  void takePosition(const YAML::Node& node, double yaw) {
    limits_.goOn(file_);
    const std::string name = "position " + std::to_string(path_.poses.size() + 1);
    if (!node.IsSequence() || node.size() < 2)
      throw yamlError(node, file_,
                      name +
                          " must be a list of longitude, latitude and, if it has "
                          "one, altitude, got " +
                          describeYaml(node));
    GeodeticPosition place;
    place.longitude = numberAt(node[0], "the longitude of " + name, 360.0, "degrees");
    place.latitude = numberAt(node[1], "the latitude of " + name, 90.0, "degrees");
    const bool has_altitude = node.size() > 2;
    place.altitude = has_altitude ? numberAt(node[2], "the altitude of " + name, kHighest, "m")
                                  : plane_.altitude();
    Pose pose;
    pose.position = plane_.positionOf(place);
    if (!has_altitude) pose.position.z() = 0.0;
    if (pose.position.cwiseAbs().maxCoeff() > kLargestCoordinate)
      throw yamlError(node, file_, name + " is more than 1e6 m from the datum");
    pose.yaw = yaw;
    path_.poses.push_back(pose);
  }

  double numberAt(const YAML::Node& node, const std::string& name, double most,
                  const std::string& unit) const {
    const auto number = yamlAs<double>(node, name, file_, "a finite number");
    if (std::abs(number) <= most) return number;
    throw yamlError(node, file_,
                    name + " must be within " + decimalText(most) + " " + unit + " of 0, got " +
                        describeYaml(node));
  }

  const std::string& file_;
  base::ReadLimits& limits_;
  const LocalTangentPlane plane_;
  Path path_;
};

}  // namespace

Path geojsonPath(const WaypointText& text, const Datum& datum) {
  Path path = GeojsonReading(text, datum).read(parseYaml(text.content, text.file, text.limits));
  lookAlongPath(path);
  return path;
}

std::string geojsonText(const Path& path, const Datum& datum) {
  const LocalTangentPlane plane(datum);
  std::string places, yaws;
  for (const Pose& pose : path.poses) {
    const GeodeticPosition place = plane.geodeticOf(pose.position);
    const char* comma = places.empty() ? "" : ",";
    places += std::string(comma) + "\n   [" + decimalText(place.longitude) + ", " +
              decimalText(place.latitude) + ", " + decimalText(place.altitude) + "]";
    yaws += std::string(comma) + "\n   " +
            decimalText(std::remainder(pose.yaw + datum.yaw, 2.0 * M_PI));
  }
  // A line has at least two positions.
  const char* type = path.poses.size() > 1 ? "LineString" : "MultiPoint";
  return "{\"type\": \"FeatureCollection\", \"frame_id\": \"" + path.frame_id +
         "\", \"features\": [\n {\"type\": \"Feature\",\n  \"properties\": {\"yaw\": [" + yaws +
         "]},\n  \"geometry\": {\"type\": \"" + type + "\", \"coordinates\": [" + places +
         "]}}]}\n";
}

}  // namespace grid_path_planner::path
