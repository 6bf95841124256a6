// Where the weights of a map increased and where they decreased.
//
//   const CostChanges changes = costChanges(before.weights(), after.weights(), changed);
//
// Compares eight cells at a time. Blocked counts as more than any weight.
#pragma once

#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/grid/grid.h"

namespace grid_path_planner::planners {

// The smallest rectangles around the cells whose weights increased and decreased.
struct CostChanges {
  grid::CellRect increased;
  grid::CellRect decreased;
};

// Of the cells of `rect`. Precondition: it lies in both maps, which are of the same size.
CostChanges costChanges(const grid::Grid<costmap::CostGrid::Weight>& before,
                        const grid::Grid<costmap::CostGrid::Weight>& after,
                        const grid::CellRect& rect);

}  // namespace grid_path_planner::planners
