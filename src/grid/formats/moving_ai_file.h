// The .map format of the MovingAI benchmarks (Sturtevant 2012).
//
//   type octile
//   height 2
//   width 3
//   map
//   ..@
//   TG.
//
// '.' and 'G' are free; '@', 'O', 'T', 'S' and 'W' are occupied, and so is every other letter, with
// a warning. The first line of the map is row 0.
#pragma once

#include <string>

#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

// The map that `text`, the content of `file`, holds. Throws InputError naming the file and line.
OccupancyGrid parseMovingAi(const std::string& text, const std::string& file,
                            MapFileOptions& options);

}  // namespace grid_path_planner::grid
