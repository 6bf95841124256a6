#include "planners/tables/precomputed_table.h"

#include <algorithm>

#include "planners/core/cost_changes.h"

namespace grid_path_planner::planners {

using costmap::CostGrid;
using grid::CellRect, grid::GridGeometry;

CellRect costDecreases(const CostGrid& before, const CostGrid& after, const CellRect& rect) {
  return costChanges(before.weights(), after.weights(), rect).decreased;
}

bool looseAfter(const GridGeometry& geometry, std::size_t cells, const CellRect& hull) {
  const int side = std::max(geometry.width(), geometry.height());
  return cells > geometry.size() / 4 || std::max(hull.width, hull.height) > side / 8;
}

}  // namespace grid_path_planner::planners
