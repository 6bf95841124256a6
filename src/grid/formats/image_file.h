// Images as maps, by map_server's rules (its image_loader.cpp).
//
// A pixel v means p = (255 - v) / 255, or v / 255 with `negate`: occupied where p >
// occupied_thresh, free where p < free_thresh. Between them: unknown in TRINARY; in SCALE 1 + 98 (p -
// free_thresh) / (occupied_thresh - free_thresh), cut to an integer, and unknown where the pixel is
// transparent. RAW takes v itself (255 - v with `negate`) up to 100 and all above for unknown.
//
// A colour image is averaged over its channels, in TRINARY over its alpha channel too, as
// map_server does; `warn` is told. Of a PNG of 16 bits the upper 8 count. Unlike map_server, which takes
// the numbers of a palette for greys, its colours count, and a PGM may have 16 bits.
#pragma once

#include <string>

#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

struct PixelRule {
  MapMode mode = MapMode::TRINARY;
  bool negate = false;
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;  // under 50 / 255, so that value 205 is unknown
};

// The image `file` with the geometry given, where `options` do not override it. Throws InputError
// naming the file where it is no image that can be read.
OccupancyGrid readImageFile(const std::string& file, const PixelRule& rule, double resolution,
                            const Origin& origin, MapFileOptions& options);

// The image `file` without a YAML, with cells of 1 m. Throws InputError naming the file where it is no
// image that can be read, or has fewer columns than `options` ask for.
OccupancyGrid readPlainImage(const std::string& file, MapFileOptions& options);

// The bytes of a binary PGM of `map`. TRINARY: 254 free, 205 unknown, 0 occupied. RAW: the value,
// 255 for -1. Throws InputError for SCALE, which would need transparency.
std::string pgmOfMap(const OccupancyGrid& map, MapMode mode, const OccupancyThresholds& thresholds);

}  // namespace grid_path_planner::grid
