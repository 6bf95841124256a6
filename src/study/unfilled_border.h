// The blocks that the original study's filter2d left as they were made.
//
// Its downsampled map has ceil(side / kernel) blocks a side, and only those whose middle cell, at
// half the kernel rounded down, lies in the map were ever written. The others stayed free, whatever
// the map holds there: at 366x362 cells one column and one row at kernel 5, one column at kernel 7,
// none at kernel 3.
#pragma once

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::study {

// Whether the block of `cell` was left unfilled.
bool inUnfilledBlock(grid::Cell cell, const grid::GridGeometry& geometry, int kernel);

// The map with the cells of these blocks free, so that any rule makes the blocks free.
grid::OccupancyGrid withUnfilledBorder(const grid::OccupancyGrid& map, int kernel);

// How many of these blocks a path visits, one that it comes back to again.
std::size_t unfilledBlocksOf(const path::Path& path, const grid::GridGeometry& geometry,
                             int kernel);

}  // namespace grid_path_planner::study
