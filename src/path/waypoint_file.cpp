#include "grid_path_planner/path/waypoint_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <iomanip>
#include <locale>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/level_quaternion.h"
#include "grid_path_planner/base/yaml_file.h"
#include "path/plain_waypoints.h"

namespace grid_path_planner::path {

using base::describeYaml, base::InputError, base::kLargestYaml, base::OutputFile, base::parseYaml,
    base::readWholeFile, base::writeFileAtomically, base::yamlAs, base::yamlError, base::yamlHas,
    base::yamlNode, base::yamlValueOr, base::YawAndTilt, base::yawAndTiltOfQuaternion;

namespace {

constexpr int kDecimalsOfMetres = 6, kDecimalsOfTurns = 9;  // in the file

// One entry of the list, with what an error about it has to say.
class Entry {
 public:
  Entry(const YAML::Node& node, std::size_t number, const std::string& file)
      : node_(node), name_("waypoint " + std::to_string(number)), file_(file) {}

  void appendTo(WaypointFile& waypoints) const {
    if (node_.IsMap()) checkKeys(node_, name_, {});
    if (node_.IsMap() && node_["x"] && !node_["position"])
      waypoints.path.poses.push_back(shortForm());
    else
      appendLongForm(waypoints);
  }

 private:
  // {x: 13.5, y: -13.5, yaw: 1.69}, with or without a z.
  Pose shortForm() const {
    checkKeys(node_, name_, {"x", "y", "z", "yaw"});
    Pose pose;
    pose.position.x() = coordinate(node_, "x");
    pose.position.y() = coordinate(node_, "y");
    if (node_["z"]) pose.position.z() = coordinate(node_, "z");
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
      pose.position[axis] = coordinate(position, std::string(1, "xyz"[axis]));
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

  double coordinate(const YAML::Node& position, const std::string& key) const {
    const double value = number(position, key);
    if (std::abs(value) <= kLargestCoordinate) return value;
    throw yamlError(
        position[key], file_,
        key + " of " + name_ + " must be within 1e6 m of 0, got " + describeYaml(position[key]));
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

std::string frameOf(const YAML::Node& root, const std::string& file) {
  if (!yamlHas(root, "header", file)) return "map";
  std::string frame =
      yamlValueOr<std::string>(root["header"], "frame_id", file, "the name of a frame", "map");
  if (!frame.empty() && frame.front() == '/') frame.erase(0, 1);
  if (frame.empty())
    throw yamlError(root["header"], file, "frame_id must be the name of a frame, got an empty one");
  return frame;
}

// With so many decimals, of which those that are 0 are left out but for the first: other readers of
// YAML take 1e-05 for a string and 4 for an integer.
std::string decimal(double value, int decimals) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(decimals) << value;
  std::string text = out.str();
  text.erase(std::max(text.find_last_not_of('0') + 1, text.find('.') + 2));
  return text == "-0.0" ? "0.0" : text;
}

double rounded(double value, int decimals) {
  return std::strtod(decimal(value, decimals).c_str(), nullptr);
}

// The z and w of an orientation as they are written, which read and written again are the same: what
// is nearest to them on the circle is rounded until nothing changes. Each step comes nearer to it.
std::pair<double, double> writtenOrientation(double yaw) {
  yaw = std::remainder(yaw, 2.0 * M_PI);
  std::pair<double, double> before, written = {2.0, 2.0};
  do {
    before = written;
    written = {rounded(std::sin(yaw / 2), kDecimalsOfTurns),
               rounded(std::cos(yaw / 2), kDecimalsOfTurns)};
    yaw = 2.0 * std::atan2(written.first, written.second);
  } while (written != before);
  return written;
}

// Whether every YAML reader takes it for text: 1.1 has words for yes and no, and numbers of digits.
bool isPlainWord(const std::string& name) {
  static const std::set<std::string> words = {"null", "true", "false", "yes", "no",
                                              "on",   "off",  "y",     "n"};
  const auto plain = [](unsigned char letter) {
    return std::isalnum(letter) || letter == '_' || letter == '/';
  };
  std::string lower;
  for (const unsigned char letter : name) lower += static_cast<char>(std::tolower(letter));
  return std::all_of(name.begin(), name.end(), plain) && !name.empty() &&
         !std::isdigit(static_cast<unsigned char>(name.front())) && words.count(lower) == 0;
}

// A name as a YAML scalar: plain where it cannot be mistaken for anything else. Nothing that means
// something to a shell stays itself, for whoever lets one read the file.
std::string scalar(const std::string& name) {
  if (isPlainWord(name)) return name;
  std::string quoted = "\"";
  for (const char letter : name) {
    constexpr char kHex[] = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(letter);
    if (byte < 0x20 || std::strchr("\"'$`\\", letter))
      quoted += std::string("\\x") + kHex[byte / 16] + kHex[byte % 16];
    else
      quoted += letter;
  }
  return quoted + '"';
}

void checkCanBeRead(const std::string& file, const Path& path) {
  if (path.empty()) throw InputError(file, "is not written: a path without waypoints");
  const auto control = [](char letter) { return static_cast<unsigned char>(letter) < 0x20; };
  if (path.frame_id.empty() || path.frame_id == "/" ||
      std::any_of(path.frame_id.begin(), path.frame_id.end(), control))
    throw InputError(file, "is not written: the path's frame has no proper name");
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const Pose& pose = path.poses[i];
    if (pose.position.allFinite() && std::isfinite(pose.yaw) &&
        pose.position.cwiseAbs().maxCoeff() <= kLargestCoordinate)
      continue;
    std::ostringstream message;
    message << "is not written: waypoint " << i + 1 << " (" << pose.position.x() << ", "
            << pose.position.y() << ", " << pose.position.z() << ", yaw " << pose.yaw
            << ") is not finite and within 1e6 m of 0";
    throw InputError(file, message.str());
  }
}

}  // namespace

namespace {

// Few letters may name many waypoints, by YAML's aliases.
WaypointFile waypointsWithin(const std::string& file, base::ReadLimits& limits) {
  const std::string text = readWholeFile(file, kLargestYaml, limits);
  limits.check(file, text.size());  // a waypoint takes less than its text
  if (std::optional<Path> plain = plainWaypoints(text)) return {*std::move(plain), 0.0};
  const YAML::Node root = parseYaml(text, file, limits);
  const YAML::Node waypoints = yamlNode(root, "waypoints", file, "a list of waypoints");
  if (!waypoints.IsSequence() || waypoints.size() == 0)
    throw yamlError(waypoints, file,
                    "waypoints must be a list of at least one waypoint, got " +
                        (waypoints.IsSequence() ? "an empty list" : describeYaml(waypoints)));
  WaypointFile read;
  read.path.frame_id = frameOf(root, file);
  limits.take(file, waypoints.size() * sizeof(Pose));
  read.path.poses.reserve(waypoints.size());
  for (const YAML::Node& node : waypoints) {
    limits.goOn(file);
    Entry(node, read.path.poses.size() + 1, file).appendTo(read);
  }
  return read;
}

}  // namespace

WaypointFile readWaypointFile(const std::string& file, const base::ReadLimits& limits) {
  return base::readWithin(file, limits,
                          [&](base::ReadLimits& within) { return waypointsWithin(file, within); });
}

void writeWaypointFile(const OutputFile& file, const Path& path) {
  checkCanBeRead(file.name(), path);
  std::string text = "header: {frame_id: " + scalar(path.frame_id) + "}\nwaypoints:\n";
  for (const Pose& pose : path.poses) {
    const Eigen::Vector3d& p = pose.position;
    const auto [z, w] = writtenOrientation(pose.yaw);
    text += "  - position: {x: " + decimal(p.x(), kDecimalsOfMetres) +
            ", y: " + decimal(p.y(), kDecimalsOfMetres) +
            ", z: " + decimal(p.z(), kDecimalsOfMetres) +
            "}\n    orientation: {x: 0.0, y: 0.0, z: " + decimal(z, kDecimalsOfTurns) +
            ", w: " + decimal(w, kDecimalsOfTurns) + "}\n";
  }
  writeFileAtomically(file, text);
}

}  // namespace grid_path_planner::path
