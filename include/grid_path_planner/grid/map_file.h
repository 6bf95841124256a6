// Occupancy maps in files: map_server YAML with its image, MovingAI .map, a plain image, a drawing
// (grid/formats/drawing_file.h), rectangles (grid/rectangle_map_file.h), and the text that `rostopic
// echo` prints of a nav_msgs/OccupancyGrid. Bags are read by ros/bag.h, which needs ROS.
//
//   OccupancyGrid map = readMapFile("maps/site.yaml");
//
// The first line of a MovingAI map is row 0; the first line of an image is the last row.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::grid {

constexpr std::size_t kLargestMapFile = std::size_t{1} << 30;  // bytes

// map_server's three conversions of a pixel to an occupancy.
enum class MapMode { TRINARY, SCALE, RAW };
const std::vector<std::pair<const char*, MapMode>>& choicesOf(MapMode);

// How an image without a YAML becomes a map; Park (2013), appendix, has it with 32 to 256 columns.
struct PlainImageOptions {
  // Pixels above the threshold that separates dark and bright best are free, all others occupied
  // (Otsu 1979); false: as map_server takes them.
  bool otsu = false;
  // Resampled, by the pixel nearest the middle of each cell, to so many columns and rows in
  // proportion; 0: a cell a pixel.
  int columns = 0;

  bool none() const { return !otsu && columns == 0; }
};

struct MapFileOptions {
  // For files that have none of their own (MovingAI, image): 1 m cells and origin 0 by default. For
  // others they override.
  std::optional<double> resolution;
  std::optional<Origin> origin;
  // Whether an image without a YAML is refused where `resolution` is not given: its cells are hardly
  // ever 1 m wide.
  bool images_need_resolution = false;
  // Whether such an image is warned of, where it is read.
  bool warn_of_cells_of_images = false;
  // Other files are refused with any of these.
  PlainImageOptions plain_image;
  // Of the map in a bag; empty: projected_map, or the only one. Other files are refused with one (ros/bag.h).
  std::string bag_topic;
  // Called with a message where a file is doubtful: a colour image, letters that the format does not
  // define.
  std::function<void(const std::string&)> warn;
  // What reading may take, the map itself included.
  base::ReadLimits limits;
};

// The geometry of a map in `file` with its own resolution and origin, where `options` do not override
// them. Throws InputError naming the file for what GridGeometry refuses.
GridGeometry mapGeometry(const std::string& file, int width, int height, double resolution,
                         const Origin& origin, const MapFileOptions& options);

// Reads any of the formats above, recognised by extension and content. Throws InputError naming the
// file, and the line or value, or the limit that the map would exceed, before memory is taken for it.
OccupancyGrid readMapFile(const std::string& file, const MapFileOptions& options = {});

// Which row of the map a file begins with: images (map_server's too) with the last, the uppermost;
// all others, bags included, with row 0. Throws InputError for a file that cannot be read.
enum class RowOrder { FIRST_ROW_FIRST, LAST_ROW_FIRST };
RowOrder rowOrderOf(const std::string& file);

// Writes `file` (a map_server YAML) and its image beside it, whose name is made of that of `file` and
// of its own content: name-0123456789abcdef.pgm. In TRINARY mode -1, 0 and 100 survive reading back,
// in RAW mode every value does; SCALE is refused. No reader gets the YAML of one map with the image
// of another, whoever is killed or writes meanwhile (base::writeFileWithPart). Throws InputError
// naming the file that cannot be written.
void writeMapServerFile(const base::OutputFile& file, const OccupancyGrid& map,
                        MapMode mode = MapMode::TRINARY,
                        const OccupancyThresholds& thresholds = {});

// Writes the image alone, .pgm or .png, which keeps neither resolution nor origin.
void writeImageFile(const std::string& file, const OccupancyGrid& map,
                    MapMode mode = MapMode::TRINARY, const OccupancyThresholds& thresholds = {});

// Writes a MovingAI .map: '.' free, 'T' unknown, '@' occupied (all but '.' and 'G' read back as
// occupied, so unknown does not survive). Row 0 is the first line.
void writeMovingAiFile(const std::string& file, const OccupancyGrid& map,
                       const OccupancyThresholds& thresholds = {});

}  // namespace grid_path_planner::grid
