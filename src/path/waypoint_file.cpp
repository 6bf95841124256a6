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

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/yaml_file.h"
#include "path/plain_waypoints.h"
#include "path/waypoint_entry.h"

namespace grid_path_planner::path {

using base::describeYaml, base::kLargestYaml, base::OutputFile, base::parseYaml,
    base::readWholeFile, base::writeFileAtomically, base::yamlError, base::yamlHas, base::yamlNode,
    base::yamlValueOr;

namespace {

std::string frameOf(const YAML::Node& root, const std::string& file) {
  if (!yamlHas(root, "header", file)) return "map";
  std::string frame =
      yamlValueOr<std::string>(root["header"], "frame_id", file, "the name of a frame", "map");
  frame = withoutSlash(std::move(frame));
  checkFrameName(root["header"], file, frame);
  return frame;
}

double rounded(double value, int decimals) {
  return std::strtod(yamlDecimal(value, decimals).c_str(), nullptr);
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
    appendWaypoint(node, read.path.poses.size() + 1, file, read);
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
    text += "  - position: {x: " + yamlDecimal(p.x(), kDecimalsOfMetres) +
            ", y: " + yamlDecimal(p.y(), kDecimalsOfMetres) +
            ", z: " + yamlDecimal(p.z(), kDecimalsOfMetres) +
            "}\n    orientation: {x: 0.0, y: 0.0, z: " + yamlDecimal(z, kDecimalsOfTurns) +
            ", w: " + yamlDecimal(w, kDecimalsOfTurns) + "}\n";
  }
  writeFileAtomically(file, text);
}

}  // namespace grid_path_planner::path
