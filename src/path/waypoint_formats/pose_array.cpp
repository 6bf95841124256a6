#include <cmath>

#include "grid_path_planner/base/yaml_file.h"
#include "path/waypoint_entry.h"
#include "path/waypoint_formats/waypoint_texts.h"

namespace grid_path_planner::path {

using base::describeYaml, base::InputError, base::parseYaml, base::yamlError, base::yamlHas,
    base::yamlNode, base::yamlValueOr;

Path poseArrayPath(const WaypointText& text) {
  const std::string& file = text.file;
  const YAML::Node root = parseYaml(text.content, file, text.limits);
  const YAML::Node poses = yamlNode(root, "poses", file, "a list of poses");
  if (!poses.IsSequence() || poses.size() == 0)
    throw yamlError(poses, file,
                    "poses must be a list of at least one pose, got " +
                        (poses.IsSequence() ? "an empty list" : describeYaml(poses)));
  text.limits.take(file, poses.size() * sizeof(Pose));
  WaypointFile read;
  if (yamlHas(root, "header", file)) {
    const std::string frame = withoutSlash(
        yamlValueOr<std::string>(root["header"], "frame_id", file, "the name of a frame", ""));
    if (!frame.empty()) {
      checkFrameName(root["header"], file, frame);
      read.path.frame_id = frame;
    }
  }
  for (const YAML::Node& node : poses) {
    text.limits.goOn(file);
    const bool of_path = node.IsMap() && node["pose"] && !node["position"];  // nav_msgs/Path
    appendWaypoint(of_path ? node["pose"] : node, read.path.poses.size() + 1, file, read);
  }
  return read.path;
}

std::string poseArrayText(const Path& path) {
  std::string text = "header:\n  seq: 0\n  stamp:\n    secs: 0\n    nsecs: 0\n  frame_id: \"" +
                     path.frame_id + "\"\nposes:\n";
  for (const Pose& pose : path.poses) {
    const Eigen::Vector3d& p = pose.position;
    text += "  -\n    position:\n      x: " + yamlDecimal(p.x(), kDecimalsOfMetres) +
            "\n      y: " + yamlDecimal(p.y(), kDecimalsOfMetres) +
            "\n      z: " + yamlDecimal(p.z(), kDecimalsOfMetres) +
            "\n    orientation:\n      x: 0.0\n      y: 0.0\n      z: " +
            yamlDecimal(std::sin(pose.yaw / 2.0), kDecimalsOfTurns) +
            "\n      w: " + yamlDecimal(std::cos(pose.yaw / 2.0), kDecimalsOfTurns) + "\n";
  }
  return text;
}

}  // namespace grid_path_planner::path
