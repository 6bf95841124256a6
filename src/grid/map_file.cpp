#include "grid_path_planner/grid/map_file.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "grid/formats/drawing_file.h"
#include "grid/formats/image_file.h"
#include "grid/formats/map_server_file.h"
#include "grid/formats/moving_ai_file.h"
#include "grid/formats/occupancy_dump.h"
#include "grid/formats/rectangle_map_file.h"
#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/yaml_file.h"

namespace grid_path_planner::grid {

using base::dropByteOrderMark, base::extensionOf, base::InputError, base::kLargestYaml,
    base::parseYaml, base::ReadLimits, base::readWholeFile, base::readWithin;

namespace {

bool isOneOf(const std::string& text, std::initializer_list<const char*> choices) {
  return std::find(choices.begin(), choices.end(), text) != choices.end();
}

bool startsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

bool isImage(const std::string& content, const std::string& extension) {
  using namespace std::literals;
  for (const std::string_view signature :
       {"\x89PNG"sv, "\xff\xd8\xff"sv, "BM"sv, "II*\0"sv, "MM\0*"sv, "P1"sv, "P2"sv, "P3"sv, "P4"sv,
        "P5"sv, "P6"sv})
    if (startsWith(content, signature)) return true;
  return isOneOf(extension, {"pbm", "pgm", "png", "ppm", "bmp", "jpg", "jpeg", "tif", "tiff"});
}

bool isMovingAi(const std::string& content, const std::string& extension) {
  return startsWith(content, "type ") || startsWith(content, "type\t") || extension == "map";
}

bool isRectangleMap(const std::string& content, const std::string& extension) {
  return looksLikeRectangleMap(content) || extension == "rectangles";
}

bool isBag(const std::string& content, const std::string& extension) {
  return startsWith(content, "#ROSBAG") || extension == "bag";
}

bool isMapServerYaml(const YAML::Node& root) {
  return root.IsMap() && root["image"];
}

OccupancyGrid readYamlMap(const std::string& content, const std::string& file,
                          MapFileOptions& options) {
  if (looksLikeOccupancyDump(content)) return parseOccupancyDump(content, file, options);
  if (content.size() > kLargestYaml)
    throw InputError(file, "is no map: larger than any map_server file and without 'data'");
  const YAML::Node root = parseYaml(content, file, options.limits);
  if (isMapServerYaml(root)) return readMapServerMap(root, file, options);
  if (looksLikeVectorMap(root)) return readVectorMap(root, file, options);
  throw InputError(
      file, "is no map: no 'image' (map_server), 'data' (rostopic echo) or 'vector_map' in it");
}

}  // namespace

GridGeometry mapGeometry(const std::string& file, int width, int height, double resolution,
                         const Origin& origin, const MapFileOptions& options) {
  try {
    return GridGeometry(width, height, options.resolution.value_or(resolution),
                        options.origin.value_or(origin));
  } catch (const InputError& error) {
    throw InputError(file, error.what());
  }
}

namespace {

OccupancyGrid readMap(const std::string& content, const std::string& file,
                      MapFileOptions& options) {
  const std::string extension = extensionOf(file);
  if (isBag(content, extension))
    throw InputError(file, "is a bag, which is read with ROS (grid_path_planner/ros/bag.h)");
  if (startsWith(content, "# Octomap OcTree"))
    throw InputError(file,
                     "is an octree, no map: grid_path project makes a map of it, and the node "
                     "projected_map publishes one");
  if (isImage(content, extension)) return readPlainImage(file, options);
  if (!options.plain_image.none())
    throw InputError(file,
                     "is no image: a threshold by Otsu and a number of columns are for images");
  if (isMovingAi(content, extension)) return parseMovingAi(content, file, options);
  if (isRectangleMap(content, extension)) return parseRectangleMap(content, file, options);
  return readYamlMap(content, file, options);
}

// Another one where the file was replaced, even by one of the same content: several writers may take
// turns with the same maps.
struct FileVersion {
  explicit FileVersion(const std::string& file) { ::stat(file.c_str(), &info); }
  bool operator!=(const FileVersion& other) const {
    return info.st_ino != other.info.st_ino || info.st_ctim.tv_sec != other.info.st_ctim.tv_sec ||
           info.st_ctim.tv_nsec != other.info.st_ctim.tv_nsec;
  }

  struct stat info {};
};

// A writer that replaces the map meanwhile removes the image that the old YAML names. Writers that
// never rest may be faster than a reader on a busy machine, many times in a row.
OccupancyGrid readUnlessReplaced(const std::string& file, const MapFileOptions& options,
                                 const ReadLimits& limits) {
  const auto last_try = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  while (true) {
    const FileVersion before(file);
    MapFileOptions within = options;
    within.limits = limits;
    std::string content = readWholeFile(file, kLargestMapFile, within.limits);
    dropByteOrderMark(content);
    try {
      return readMap(content, file, within);
    } catch (const InputError&) {
      const bool replaced = FileVersion(file) != before;
      if (!replaced || std::chrono::steady_clock::now() > last_try) throw;
    }
  }
}

}  // namespace

OccupancyGrid readMapFile(const std::string& file, const MapFileOptions& options) {
  return readWithin(file, options.limits, [&](const ReadLimits& limits) {
    return readUnlessReplaced(file, options, limits);
  });
}

RowOrder rowOrderOf(const std::string& file) {
  std::string content = readWholeFile(file, kLargestMapFile);
  dropByteOrderMark(content);
  const std::string extension = extensionOf(file);
  if (isBag(content, extension)) return RowOrder::FIRST_ROW_FIRST;
  if (isImage(content, extension)) return RowOrder::LAST_ROW_FIRST;
  if (isMovingAi(content, extension) || isRectangleMap(content, extension) ||
      looksLikeOccupancyDump(content) || content.size() > kLargestYaml)
    return RowOrder::FIRST_ROW_FIRST;
  return isMapServerYaml(parseYaml(content, file)) ? RowOrder::LAST_ROW_FIRST
                                                   : RowOrder::FIRST_ROW_FIRST;
}

}  // namespace grid_path_planner::grid
