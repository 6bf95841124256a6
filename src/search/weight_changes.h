// Where the weights of a map rose and where they fell.
//
//   const WeightChanges changes = changesBetween(before.weights(), after.weights(), changed);
//
// Eight cells are compared at a time. Blocked is dearer than any weight.
#pragma once

#include "grid_path_planner/grid/grid.h"
#include "grid_path_planner/terrain/cost_grid.h"

namespace grid_path_planner {

// The smallest rectangles around the cells that became dearer, and around those that became
// cheaper.
struct WeightChanges {
  CellRect dearer;
  CellRect cheaper;
};

// Of the cells of `rect`. Precondition: it lies in both maps, which are of the same size.
WeightChanges changesBetween(const Grid<CostGrid::Weight>& before,
                             const Grid<CostGrid::Weight>& after, const CellRect& rect);

}  // namespace grid_path_planner
