// Where the weights of a map rose and where they fell.
//
//   const CostChanges changes = costChanges(before.weights(), after.weights(), changed);
//
// Eight cells are compared at a time. Blocked is dearer than any weight.
#pragma once

#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/grid/grid.h"

namespace grid_path_planner::planners {

// The smallest rectangles around the cells that became dearer, and around those that became
// cheaper.
struct CostChanges {
  grid::CellRect increased;
  grid::CellRect decreased;
};

// Of the cells of `rect`. Precondition: it lies in both maps, which are of the same size.
CostChanges costChanges(const grid::Grid<costmap::CostGrid::Weight>& before,
                        const grid::Grid<costmap::CostGrid::Weight>& after,
                        const grid::CellRect& rect);

}  // namespace grid_path_planner::planners
