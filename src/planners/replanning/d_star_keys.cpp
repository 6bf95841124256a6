#include "planners/replanning/d_star_keys.h"

namespace grid_path_planner::planners {

using costmap::Connectivity, costmap::CostGrid;
using grid::Cell, grid::CellRect, grid::GridGeometry;

void DStarKeys::reset(const BackwardNodes& nodes, const CostGrid& map, Cell start) {
  nodes_ = &nodes;
  start_ = start;
  key_modifier_ = 0;
  const GridGeometry& geometry = map.geometry();
  const auto longest = static_cast<SearchKey>(geometry.width()) + geometry.height();
  const bool fits = longest * 2 * kPackedScale.straight <= kLargestHeuristic / map.minWeight();
  scale_ = fits ? map.minWeight() : CostGrid::kBlocked;
  straight_ = kPackedScale.straight * scale_;
  diagonal_ = map.motion().connectivity == Connectivity::FOUR
                  ? 2 * straight_
                  : diagonalKey(kPackedScale, map.motion().diagonal_cost) * scale_;
}

void DStarKeys::moveStart(Cell start) {
  key_modifier_ += heuristic(start_, start);
  start_ = start;
}

SearchKey DStarKeys::lowerBound(const CellRect& rect, SearchKey least_g) const {
  const auto outside = [](int at, int first, int count) {
    return std::max({0, first - at, at - (first + count - 1)});
  };
  return withKeyModifier(least_g + heuristic(outside(start_.column, rect.column, rect.width),
                                             outside(start_.row, rect.row, rect.height)));
}

}  // namespace grid_path_planner::planners
