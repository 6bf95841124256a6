// Cells that are given as rectangles, cut into rectangles anew.
//
//   fewestRectangles({{0, 0, 500, 30}}, {{77, 12, 1, 1}}, stop);  // four
//
// The work follows the lines along which the rectangles begin and end, not the cells between them:
// a large rectangle that loses one cell is a patch of three lines by three.
#pragma once

#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::planners {

// A partition of the cells that lie in a rectangle of `free` and in none of `blocked`: largest
// first, or joined runs of rows or of columns where these are fewer (see decomposition.h). `free`
// and `blocked` may overlap; none is empty. Throws Stopped.
std::vector<grid::CellRect> fewestRectangles(const std::vector<grid::CellRect>& free,
                                             const std::vector<grid::CellRect>& blocked,
                                             const base::StopToken& stop);

}  // namespace grid_path_planner::planners
