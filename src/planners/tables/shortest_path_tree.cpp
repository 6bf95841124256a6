#include "planners/tables/shortest_path_tree.h"

#include <memory>

#include "planners/tables/cost_to_go.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::CellIndex, grid::GridGeometry;

ShortestPathTree::ShortestPathTree(const CostGrid& map, const StopToken& stop)
    : map_(map), stop_(stop), diagonal_(diagonalKey(map.motion().diagonal_cost)) {
  masks_.build(map, stop);
  costs_.resize(map.geometry().size());
}

void ShortestPathTree::run(std::uint32_t start) {
  const GridGeometry& geometry = map_.geometry();
  const std::shared_ptr<const CostGrid> lent(std::shared_ptr<void>(), &map_);
  const CostToGo field(lent, {geometry.cell(CellIndex(start))}, 1, stop_);
  StopPoll poll(stop_, 64);
  std::uint32_t index = 0;
  for (int row = 0; row < geometry.height(); ++row) {
    poll();
    for (int column = 0; column < geometry.width(); ++column, ++index) {
      const Cell cell{column, row};
      costs_[index] = field.reached(cell) ? field.keyIn(kWideScale, cell) : kInfiniteKey;
    }
  }
}

std::uint32_t ShortestPathTree::parent(std::uint32_t index) const {
  for (unsigned mask = masks_[index]; mask != 0; mask &= mask - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(mask));
    const auto from = static_cast<std::uint32_t>(index + masks_.offsets()[step]);
    if (costs_[from] + length(from, index, step) == costs_[index]) return from;
  }
  return index;
}

}  // namespace grid_path_planner::planners
