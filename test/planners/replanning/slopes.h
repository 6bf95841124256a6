// A map for planners that repair, large enough that searches ask whether to stop.
//
//   Slopes slopes;
//   const CellRect changed = slopes.editOn(path, 0.5);  // in the middle of the path
//   planner.update(slopes.map(), {changed}, stop);
#pragma once

#include <algorithm>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/replanning/journey.h"
#include "support/cost_maps.h"

namespace grid_path_planner::test {

// Gentle slopes with posts, across which a vehicle drives.
class Slopes {
 public:
  using Weight = costmap::CostGrid::Weight;

  Slopes() : weights_(grid::GridGeometry(300, 300, 1.0)) {
    for (int row = 0; row < 300; ++row)
      for (int column = 0; column < 300; ++column)
        weights_[grid::Cell{column, row}] = static_cast<Weight>(
            column % 50 == 25 && row % 60 < 40 ? 0 : 1 + (column * 7 + row * 5) % 23);
    map_ = costsOf(weights_);
  }

  const Map& map() const { return map_; }
  Map edit(const grid::CellRect& rect, Weight weight) {
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      std::fill_n(weights_.row(row) + rect.column, rect.width, weight);
    map_ = costsOf(weights_, {}, map_->revision() + 1);
    return map_;
  }
  // Blocks a few cells on the path.
  grid::CellRect editOn(const std::vector<grid::Cell>& path, double share) {
    const grid::Cell cell =
        path[static_cast<std::size_t>(share * static_cast<double>(path.size()))];
    const grid::CellRect rect = grid::CellRect{cell.column - 2, cell.row - 2, 5, 5};
    edit(rect, costmap::CostGrid::kBlocked);
    return rect;
  }

 private:
  grid::Grid<Weight> weights_;
  Map map_;
};

}  // namespace grid_path_planner::test
