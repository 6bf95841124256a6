#include "ros/messages/file_kinds.h"

#include <sstream>

namespace grid_path_planner::nodes {
namespace {

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

// The first line that is neither empty, nor a comment, nor YAML's start of a document.
std::string firstLine(const std::string& yaml) {
  std::istringstream lines(yaml);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != '#' && line != "\r" && !startsWith(line, "---")) return line;
  return "";
}

bool beginsAsWaypoints(const std::string& beginning) {
  const std::string line = firstLine(beginning);
  return startsWith(line, "header:") || startsWith(line, "waypoints:");
}

bool beginsAsMapServer(const std::string& beginning) {
  return startsWith(firstLine(beginning), "image:");
}

bool beginsAsOctree(const std::string& beginning) {
  return startsWith(beginning, "# Octomap OcTree ");
}

// A log that began on a full disk is empty, and must not keep the node from starting again.
bool beginsAsFlight(const std::string& beginning) {
  return beginning.empty() || startsWith(beginning, "grid_path_planner flight ");
}

}  // namespace

const FileKind& waypointFiles() {
  static const FileKind kind{"waypoint file", {"yaml", "yml"}, beginsAsWaypoints};
  return kind;
}

const FileKind& mapServerFiles() {
  static const FileKind kind{"map file", {"yaml", "yml"}, beginsAsMapServer};
  return kind;
}

const FileKind& octreeFiles() {
  static const FileKind kind{"octree file", {"bt", "ot"}, beginsAsOctree};
  return kind;
}

const FileKind& flightLogs() {
  static const FileKind kind{"flight log", {"flight"}, beginsAsFlight};
  return kind;
}

const FileKind& mapFiles() {
  static const FileKind kind{"map file",
                             {"yaml", "yml", "txt", "map", "rectangles", "bag", "pgm", "ppm", "pbm",
                              "png", "bmp", "jpg", "jpeg", "tif", "tiff"},
                             nullptr};
  return kind;
}

const FileKind& worldFiles() {
  static const FileKind kind{"world", {"sdf", "world", "xml"}, nullptr};
  return kind;
}

const FileKind& sensorFaultFiles() {
  static const FileKind kind{"file of faults", {"yaml", "yml"}, nullptr};
  return kind;
}

const FileKind& zoneFiles() {
  static const FileKind kind{"file of zones", {"yaml", "yml"}, nullptr};
  return kind;
}

const FileKind& markerLayoutFiles() {
  static const FileKind kind{"layout of markers", {"yaml", "yml"}, nullptr};
  return kind;
}

}  // namespace grid_path_planner::nodes
