// Lists of changed rectangles for whoever can take few: disjointRects() (cell.h) of a length of one's own.
#pragma once

#include <cstddef>
#include <vector>

#include "grid_path_planner/grid/cell.h"

namespace grid_path_planner::grid {

// As disjointRects(), but at most `most`, 1 or more.
std::vector<CellRect> fewerRects(const std::vector<CellRect>& rects, std::size_t most);

}  // namespace grid_path_planner::grid
