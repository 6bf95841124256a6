// By what cells wait in a search backwards to a start that moves: label + estimate of the way from
// the start, as D* Lite does it (Koenig & Likhachev, AAAI 2002).
//
//   DStarKeys keys;
//   keys.begin(labels, map, start);
//   keys.move(next_start);
//   if (keys.of(index) < keys.withKeyModifier(cost)) use(index);  // it may matter to a way of that cost
//
// When the start moves, all new keys are raised by the estimate between the old and the new start:
// so a key told before is a lower bound of the one that would be told now.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "planners/replanning/backward_nodes.h"

namespace grid_path_planner::planners {

class DStarKeys {
 public:
  using Index = BackwardNodes::Index;

  // `labels` outlives this; estimates hold as long as no weight is less than map.cheapest().
  void begin(const BackwardNodes& labels, const costmap::CostGrid& map, grid::Cell start);
  void move(grid::Cell start);

  // Precondition: the cell has a label.
  SearchKey of(Index index) const {
    return withKeyModifier(labels_->g(index) + estimate(labels_->cell(index), start_));
  }
  // What no cell of `rect` is below, if it has no label below `least`.
  SearchKey leastOf(const grid::CellRect& rect, SearchKey least) const;
  // What is left of the cell's label in 32 bits.
  std::uint32_t order(Index index) const {
    return static_cast<std::uint32_t>(labels_->g(index) >> kLabelShift);
  }
  // What the cell of such a label or cost would wait by at the start.
  SearchKey withKeyModifier(SearchKey key) const { return key + key_modifier_; }

  // The weight that estimates are of.
  costmap::CostGrid::Weight scale() const { return scale_; }
  // Whether keys still hold what they are raised by.
  bool inRange() const { return key_modifier_ <= kLargestRaise; }
  grid::Cell start() const { return start_; }
  const BackwardNodes& labels() const { return *labels_; }

 private:
  // Labels, estimates and what keys are raised by must not overflow together.
  static constexpr SearchKey kLargestEstimate = kInfiniteKey / 4;
  static constexpr SearchKey kLargestRaise = kInfiniteKey / 4;
  static_assert(kInfiniteKey - BackwardNodes::kLargest > kLargestEstimate + kLargestRaise);
  static constexpr unsigned kLabelShift = 11;
  static_assert(BackwardNodes::kLargest >> kLabelShift <= ~std::uint32_t{0});

  SearchKey estimate(grid::Cell from, grid::Cell to) const {
    return estimate(std::abs(from.column - to.column), std::abs(from.row - to.row));
  }
  SearchKey estimate(int columns, int rows) const {
    const auto both = static_cast<SearchKey>(std::min(columns, rows));
    return both * diagonal_ + (static_cast<SearchKey>(std::max(columns, rows)) - both) * straight_;
  }

  const BackwardNodes* labels_ = nullptr;
  grid::Cell start_;
  SearchKey key_modifier_ = 0;
  costmap::CostGrid::Weight scale_ = 0;
  SearchKey straight_ = 0;
  SearchKey diagonal_ = 0;
};

}  // namespace grid_path_planner::planners
