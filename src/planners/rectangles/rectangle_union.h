// A small partition into rectangles of cells that are given as rectangles.
//
//   fewestRectangles({{0, 0, 500, 30}}, {{77, 12, 1, 1}}, stop);  // four
//
// The time is in proportion to the distinct edges of the rectangles along both axes, not to their
// cells (coordinate compression): a large rectangle that loses one cell is a grid of three by three.
#pragma once

#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::planners {

// A partition of the cells that lie in a rectangle of `free` and in none of `blocked`: that of
// largestFirst, or mergedRuns of rows or of columns where these are fewer (decomposition.h). `free`
// and `blocked` may overlap; no rectangle is empty. Throws Stopped.
std::vector<grid::CellRect> fewestRectangles(const std::vector<grid::CellRect>& free,
                                             const std::vector<grid::CellRect>& blocked,
                                             const base::StopToken& stop);

}  // namespace grid_path_planner::planners
