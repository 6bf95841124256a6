// Dijkstra's shortest-path tree: the costs from one cell to all others, and the parent of each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/keys.h"
#include "planners/core/steps.h"
#include "planners/tables/cost_to_go.h"

namespace grid_path_planner::planners {

class ShortestPathTree {
 public:
  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return geometry.size() * (sizeof(SearchKey) + 1) + CostToGo::bytesFor(geometry);
  }

  // Both outlive this. Throws Stopped.
  ShortestPathTree(const costmap::CostGrid& map, const base::StopToken& stop);

  // Throws Stopped and TooExpensive.
  void run(std::uint32_t start);

  // Of the last run; kInfiniteKey for unreachable cells.
  const std::vector<SearchKey>& costs() const { return costs_; }
  // The cell before the last on a least-cost path to a cell: of several the first by step number.
  // The cell itself where there is none.
  std::uint32_t parent(std::uint32_t index) const;
  const StepMasks& masks() const { return masks_; }

 private:
  SearchKey length(std::uint32_t from, std::uint32_t to, std::uint32_t step) const {
    const costmap::CostGrid::Weight* weights = map_.weights().values().data();
    return (step < 4 ? kStraightKey : diagonal_) * std::max(weights[from], weights[to]);
  }

  const costmap::CostGrid& map_;
  const base::StopToken& stop_;
  SearchKey diagonal_;
  StepMasks masks_;
  std::vector<SearchKey> costs_;
};

}  // namespace grid_path_planner::planners
