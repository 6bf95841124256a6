#include "path/waypoint_entry.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <set>
#include <sstream>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/level_quaternion.h"

namespace grid_path_planner::path {

using base::describeYaml, base::InputError, base::yamlAs, base::yamlError, base::YawAndTilt,
    base::yawAndTiltOfQuaternion;

namespace {

// One entry of the list, with what an error about it has to say.
class WaypointEntry {
 public:
  WaypointEntry(const YAML::Node& node, std::size_t number, const std::string& file)
      : node_(node), name_("waypoint " + std::to_string(number)), file_(file) {}

  void appendTo(WaypointFile& waypoints) const {
    if (node_.IsMap()) checkKeys(node_, name_, {});
    const double largest = largestCoordinateIn(waypoints.path.frame_id);
    if (node_.IsMap() && node_["x"] && !node_["position"])
      waypoints.path.poses.push_back(shortForm(largest));
    else
      appendLongForm(waypoints);
  }

 private:
  // {x: 13.5, y: -13.5, yaw: 1.69}, with or without a z.
  Pose shortForm(double largest) const {
    checkKeys(node_, name_, {"x", "y", "z", "yaw"});
    Pose pose;
    pose.position.x() = coordinate(node_, "x", largest);
    pose.position.y() = coordinate(node_, "y", largest);
    if (node_["z"]) pose.position.z() = coordinate(node_, "z", largest);
    pose.yaw = std::remainder(number(node_, "yaw"), 2.0 * M_PI);
    return pose;
  }

  void appendLongForm(WaypointFile& waypoints) const {
    const YAML::Node position = part("position");
    const YAML::Node orientation = part("orientation");
    checkKeys(position, "the position of " + name_, {"x", "y", "z"});
    checkKeys(orientation, "the orientation of " + name_, {"x", "y", "z", "w"});
    Pose pose;
    for (int axis = 0; axis < 3; ++axis)
      pose.position[axis] = coordinate(position, std::string(1, "xyz"[axis]),
                                       largestCoordinateIn(waypoints.path.frame_id));
    const YawAndTilt turned = yawAndTilt(orientation);
    pose.yaw = turned.yaw;
    waypoints.path.poses.push_back(pose);
    waypoints.tilt = std::max(waypoints.tilt, turned.tilt);
  }

  // `{x: 1,5, y: 2}` has a key 5, and yaml-cpp takes the first of two keys of one name. No `known`
  // ones: any.
  void checkKeys(const YAML::Node& map, const std::string& whose,
                 const std::set<std::string>& known) const {
    std::set<std::string> seen;
    for (const auto& entry : map) {
      const auto key = yamlAs<std::string>(entry.first, "a key of " + whose, file_, "a name");
      const std::string at =
          " '" + key + "' at column " + std::to_string(entry.first.Mark().column + 1);
      if (!seen.insert(key).second)
        throw yamlError(entry.first, file_, whose + " has a second key" + at);
      if (!known.empty() && known.count(key) == 0)
        throw yamlError(entry.first, file_,
                        whose + " has the key" + at + ", which means nothing there");
    }
  }

  YAML::Node part(const std::string& key) const {
    if (!node_.IsMap())
      throw yamlError(
          node_, file_,
          name_ + " must have a position and an orientation, got " + describeYaml(node_));
    const YAML::Node part = node_[key];
    if (!part) throw yamlError(node_, file_, name_ + " has no " + key);
    if (!part.IsMap())
      throw yamlError(
          part, file_,
          "the " + key + " of " + name_ + " must have x, y and z, got " + describeYaml(part));
    return part;
  }

  double number(const YAML::Node& part, const std::string& key) const {
    const YAML::Node value = part[key];
    if (!value) throw yamlError(part, file_, name_ + " has no " + key);
    return yamlAs<double>(value, key + " of " + name_, file_, "a finite number");
  }

  double coordinate(const YAML::Node& position, const std::string& key, double largest) const {
    if (!position[key]) throw yamlError(position, file_, name_ + " has no " + key);
    return coordinateAt(position[key], key + " of " + name_, file_, largest);
  }

  YawAndTilt yawAndTilt(const YAML::Node& orientation) const {
    const double x = orientation["x"] ? number(orientation, "x") : 0.0;
    const double y = orientation["y"] ? number(orientation, "y") : 0.0;
    const double z = number(orientation, "z"), w = number(orientation, "w");
    try {
      const YawAndTilt turned = yawAndTiltOfQuaternion(x, y, z, w);
      if (turned.tilt <= kLargestWaypointTilt) return turned;
      throw InputError("the orientation must tilt by at most 0.7 rad, got " +
                       std::to_string(turned.tilt) + " rad");
    } catch (const InputError& error) {
      throw yamlError(orientation, file_, name_ + ": " + error.what());
    }
  }

  const YAML::Node node_;
  const std::string name_;
  const std::string& file_;
};

}  // namespace

void appendWaypoint(const YAML::Node& node, std::size_t number, const std::string& file,
                    WaypointFile& waypoints) {
  WaypointEntry(node, number, file).appendTo(waypoints);
}

double largestCoordinateIn(const std::string& frame_id) {
  return frame_id == "map" ? kLargestCoordinate : kLargestElsewhere;
}

std::string withinText(double largest) {
  return largest == kLargestCoordinate ? "within 1e6 m of 0" : "within 1e8 m of 0";
}

double coordinateAt(const YAML::Node& node, const std::string& name, const std::string& file,
                    double largest) {
  const auto value = yamlAs<double>(node, name, file, "a finite number");
  if (std::abs(value) <= largest) return value;
  throw yamlError(node, file,
                  name + " must be " + withinText(largest) + ", got " + describeYaml(node));
}

std::string yamlDecimal(double value, int decimals) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(decimals) << value;
  std::string text = out.str();
  text.erase(std::max(text.find_last_not_of('0') + 1, text.find('.') + 2));
  return text == "-0.0" ? "0.0" : text;
}

std::string withoutSlash(std::string frame) {
  return frame.erase(0, frame.find_first_not_of('/'));
}

bool isFrameName(const std::string& frame) {
  const auto control = [](char letter) { return static_cast<unsigned char>(letter) < 0x20; };
  return !frame.empty() && std::none_of(frame.begin(), frame.end(), control);
}

void checkFrameName(const YAML::Node& header, const std::string& file, const std::string& frame) {
  if (isFrameName(frame)) return;
  throw yamlError(header, file,
                  std::string("frame_id must be the name of a frame, got ") +
                      (frame.empty() ? "an empty one" : "one with control characters"));
}

void checkCanBeRead(const std::string& file, const Path& path) {
  if (path.empty()) throw InputError(file, "is not written: a path without waypoints");
  if (!isFrameName(withoutSlash(path.frame_id)))
    throw InputError(file, "is not written: the path's frame has no proper name");
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const Pose& pose = path.poses[i];
    if (pose.position.allFinite() && std::isfinite(pose.yaw) &&
        pose.position.cwiseAbs().maxCoeff() <= largestCoordinateIn(withoutSlash(path.frame_id)))
      continue;
    std::ostringstream message;
    message << "is not written: waypoint " << i + 1 << " (" << pose.position.x() << ", "
            << pose.position.y() << ", " << pose.position.z() << ", yaw " << pose.yaw
            << ") is not finite and "
            << withinText(largestCoordinateIn(withoutSlash(path.frame_id)));
    throw InputError(file, message.str());
  }
}

}  // namespace grid_path_planner::path
