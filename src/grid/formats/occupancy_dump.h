// The text that `rostopic echo -n1 /projected_map` prints of a nav_msgs/OccupancyGrid, which is
// also how the original study stored its map.
//
//   header: {...}
//   info:
//     resolution: 0.05
//     width: 3
//     height: 2
//     origin:
//       position: {x: 0.0, y: 0.0, z: 0.0}
//       orientation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}
//   data: [0, 0, 100, -1, 0, 0]
//   ---
//
// The data, a list in brackets or one value a line behind a dash, is read as a stream: a map of
// 2000x2000 cells needs its text and 4 MB. Of several messages the first with cells is taken.
#pragma once

#include <string>

#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

// Whether `text` has a key `data` at its left edge, as a dump has.
bool looksLikeOccupancyDump(const std::string& text);

// The map that `text`, the content of `file`, holds. Throws InputError naming the file and line.
OccupancyGrid parseOccupancyDump(const std::string& text, const std::string& file,
                                 MapFileOptions& options);

}  // namespace grid_path_planner::grid
