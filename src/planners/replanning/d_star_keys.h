// The keys of D* Lite (Koenig & Likhachev 2002): g-value + heuristic + key modifier, for a backward
// search whose start moves.
//
//   DStarKeys keys;
//   keys.reset(nodes, map, start);
//   keys.moveStart(next_start);
//   if (keys.of(index) < keys.withKeyModifier(cost)) use(index);  // a path of that cost may pass it
//
// When the start moves, the key modifier k_m grows by the heuristic between the old and the new
// start. So a key computed before the move is a lower bound of the key computed after it.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "planners/replanning/backward_nodes.h"

namespace grid_path_planner::planners {

class DStarKeys {
 public:
  using Index = BackwardNodes::Index;

  // `nodes` outlives this. The heuristic is consistent as long as no weight is below
  // map.minWeight().
  void reset(const BackwardNodes& nodes, const costmap::CostGrid& map, grid::Cell start);
  void moveStart(grid::Cell start);

  // Precondition: the cell has a g-value.
  SearchKey of(Index index) const {
    return withKeyModifier(nodes_->g(index) + heuristic(nodes_->cell(index), start_));
  }
  // A lower bound of the keys of the cells of `rect` whose g-values are at least `least_g`.
  SearchKey lowerBound(const grid::CellRect& rect, SearchKey least_g) const;
  // The cell's g-value, rounded down to 32 bits.
  std::uint32_t order(Index index) const {
    return static_cast<std::uint32_t>(nodes_->g(index) >> kOrderShift);
  }
  // The key of the start if this is its g-value.
  SearchKey withKeyModifier(SearchKey g) const { return g + key_modifier_; }

  // The weight that the heuristic assumes for every step.
  costmap::CostGrid::Weight scale() const { return scale_; }
  // Whether keys with the key modifier cannot overflow.
  bool inRange() const { return key_modifier_ <= kLargestModifier; }
  grid::Cell start() const { return start_; }
  const BackwardNodes& nodes() const { return *nodes_; }

 private:
  // The sum of a g-value, a heuristic and the key modifier must not overflow.
  static constexpr SearchKey kLargestHeuristic = kInfiniteKey / 4;
  static constexpr SearchKey kLargestModifier = kInfiniteKey / 4;
  static_assert(kInfiniteKey - BackwardNodes::kLargest > kLargestHeuristic + kLargestModifier);
  static constexpr unsigned kOrderShift = 11;
  static_assert(BackwardNodes::kLargest >> kOrderShift <= ~std::uint32_t{0});

  SearchKey heuristic(grid::Cell from, grid::Cell to) const {
    return heuristic(std::abs(from.column - to.column), std::abs(from.row - to.row));
  }
  SearchKey heuristic(int columns, int rows) const {
    const auto both = static_cast<SearchKey>(std::min(columns, rows));
    return both * diagonal_ + (static_cast<SearchKey>(std::max(columns, rows)) - both) * straight_;
  }

  const BackwardNodes* nodes_ = nullptr;
  grid::Cell start_;
  SearchKey key_modifier_ = 0;
  costmap::CostGrid::Weight scale_ = 0;
  SearchKey straight_ = 0;
  SearchKey diagonal_ = 0;
};

}  // namespace grid_path_planner::planners
