// Where a map differs from the one before.
//
//   const std::vector<CellRect> changed = differences(before, after.values());
//
// Rows and pieces of rows that are equal are passed at the speed of memory.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::grid {

// Disjoint rectangles (disjointRects() of cell.h) around the cells of `before` whose value is another
// one in `after`. Precondition: `after` has a value for each cell, row by row.
std::vector<CellRect> differences(const OccupancyGrid& before,
                                  const std::vector<std::int8_t>& after);
// The same for costs of a byte, as costmap_2d has them.
std::vector<CellRect> differences(const Grid<std::uint8_t>& before, const std::uint8_t* after);

}  // namespace grid_path_planner::grid
