#include <cmath>
#include <limits>
#include <vector>

#include "grid_path_planner/base/yaml_file.h"
#include "grid_path_planner/path/headings.h"
#include "path/waypoint_entry.h"
#include "path/waypoint_formats/waypoint_texts.h"

namespace grid_path_planner::path {

using base::describeYaml, base::InputError, base::parseYaml, base::yamlAs, base::yamlError,
    base::yamlHas, base::yamlNode, base::yamlValue, base::yamlValueOr;

namespace {

constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();

// An entry of UUV simulator's list: heading and whether that is an angle of its own.
struct UuvHeading {
  double heading = 0.0;
  bool fixed = false;
};

Eigen::Vector3d uuvPoint(const YAML::Node& node, const std::string& name, const std::string& file) {
  const YAML::Node point = yamlNode(node, "point", file, "the point of " + name);
  if (!point.IsSequence() || point.size() != 3)
    throw yamlError(
        point, file,
        "the point of " + name + " must be a list [x, y, z], got " + describeYaml(point));
  Eigen::Vector3d position;
  for (int axis = 0; axis < 3; ++axis)
    position[axis] = coordinateAt(point[static_cast<std::size_t>(axis)],
                                  std::string(1, "xyz"[axis]) + " of " + name, file);
  return position;
}

UuvHeading uuvHeading(const YAML::Node& node, const std::string& file) {
  UuvHeading read;
  read.heading = yamlValueOr(node, "heading", file, "an angle in radians", 0.0);
  read.fixed = yamlValueOr(node, "use_fixed_heading", file, "true or false", false);
  return read;
}

// The entries and the frame; older files are the list alone.
struct UuvFile {
  YAML::Node waypoints;
  bool north_east_down = false;
};

UuvFile uuvFile(const YAML::Node& root, const std::string& file) {
  if (root.IsSequence()) return {root, false};
  const auto frame = yamlValue<std::string>(root, "inertial_frame_id", file, "world or world_ned");
  if (frame != "world" && frame != "world_ned")
    throw yamlError(root["inertial_frame_id"], file,
                    "inertial_frame_id must be world or world_ned, got '" + frame + "'");
  return {yamlNode(root, "waypoints", file, "a list of waypoints"), frame == "world_ned"};
}

void addHeadings(Path& path, const std::vector<UuvHeading>& headings) {
  lookAlongPath(path);
  for (std::size_t i = 0; i < headings.size(); ++i)
    if (!headings[i].fixed)
      path.poses[i].yaw = std::remainder(path.poses[i].yaw + headings[i].heading, 2.0 * M_PI);
}

}  // namespace

Path uuvPath(const WaypointText& text) {
  const std::string& file = text.file;
  const UuvFile read = uuvFile(parseYaml(text.content, file, text.limits), file);
  if (!read.waypoints.IsSequence() || read.waypoints.size() == 0)
    throw yamlError(read.waypoints, file, "waypoints must be a list of at least one waypoint");
  text.limits.take(file, read.waypoints.size() * (sizeof(Pose) + sizeof(UuvHeading)));
  Path path;
  path.frame_id = "world";
  std::vector<UuvHeading> headings;
  for (const YAML::Node& node : read.waypoints) {
    text.limits.goOn(file);
    Pose pose;
    pose.position = uuvPoint(node, "waypoint " + std::to_string(path.poses.size() + 1), file);
    headings.push_back(uuvHeading(node, file));
    UuvHeading& heading = headings.back();
    if (read.north_east_down) {
      pose.position = {pose.position.y(), pose.position.x(), -pose.position.z()};
      heading.heading = heading.fixed ? M_PI / 2.0 - heading.heading : -heading.heading;
    }
    pose.yaw = heading.fixed ? std::remainder(heading.heading, 2.0 * M_PI) : kUnset;
    path.poses.push_back(pose);
  }
  addHeadings(path, headings);
  return path;
}

std::string uuvText(const Path& path, double speed) {
  std::string text = "inertial_frame_id: world\nwaypoints:\n";
  for (const Pose& pose : path.poses) {
    const Eigen::Vector3d& p = pose.position;
    text += "- point: [" + yamlDecimal(p.x(), kDecimalsOfMetres) + ", " +
            yamlDecimal(p.y(), kDecimalsOfMetres) + ", " + yamlDecimal(p.z(), kDecimalsOfMetres) +
            "]\n  max_forward_speed: " + yamlDecimal(speed, kDecimalsOfMetres) +
            "\n  heading: " + yamlDecimal(pose.yaw, kDecimalsOfTurns) +
            "\n  use_fixed_heading: true\n";
  }
  return text;
}

}  // namespace grid_path_planner::path
