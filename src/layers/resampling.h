// Maps of other resolutions and origins on the grid of one (grid/grid_alignment.h, grid/level_grid.h), so that
// nothing is lost that matters for safety.
#pragma once

#include "grid/grid_alignment.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::layers {

// What `from` says of the cells of `to` in `rect`. Occupied (the largest value) where any cell that lies on one is
// of at least `occupied_min`; else -1 where any is unknown or where `from` does not hold all of the cell; else the
// largest value.
void resampleOccupancy(const grid::OccupancyGrid& from, const grid::GridAlignment& alignment,
                       const grid::CellRect& rect, int occupied_min, grid::OccupancyGrid& to);

// The same rule on the grid without a yaw over `map`. Throws InputError as LevelGrid.
grid::OccupancyGrid levelOccupancy(const grid::OccupancyGrid& map, int occupied_min);

// 100 in the cells of `to` on which a cell of `mask` of at least `occupied_min` lies; others stay as they are.
void addMask(const grid::OccupancyGrid& mask, const grid::GridAlignment& alignment,
             int occupied_min, grid::OccupancyGrid& to);

}  // namespace grid_path_planner::layers
