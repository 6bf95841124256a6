// A large map on which jumps pay.
#pragma once

#include <algorithm>

#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::test {

// Weights that fall with the distance to walls 40 cells apart, with gaps; 100 tiles of the jumps.
inline grid::Grid<costmap::CostGrid::Weight> slopesBetweenWalls() {
  using costmap::CostGrid;
  grid::Grid<CostGrid::Weight> weights(grid::GridGeometry(640, 640, 1.0), 1);
  for (int row = 0; row < 640; ++row)
    for (int column = 0; column < 640; ++column) {
      const int from_wall = std::min(row % 40, 40 - row % 40);
      const bool gap = column % 160 < 20;
      weights[grid::Cell{column, row}] =
          from_wall == 0 && !gap ? CostGrid::kBlocked
                                 : static_cast<CostGrid::Weight>(std::max(1, 16 - from_wall));
    }
  return weights;
}

}  // namespace grid_path_planner::test
