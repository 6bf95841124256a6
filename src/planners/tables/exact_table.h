// The cost between every two cells of a small map: with this heuristic A* expands only the cells of
// a least-cost path.
//
// 4 bytes (compact_cost.h) for every pair of cells, so twice the cells take four times the memory: a
// map of 100x100 cells 400 MB. On maps whose costs are too large for exact entries the estimates
// are too low by up to two units, so a search must re-open cells to be optimal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/zeroed_array.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/keys.h"
#include "planners/tables/compact_cost.h"

namespace grid_path_planner::planners {

// Any cost decrease makes the table unusable.
class DecreaseAnywhere {
 public:
  template <class Table>
  void add(const Table&, const grid::GridGeometry&, const grid::CellRect& rect) {
    hull_ = hull_.hull(rect);
  }
  bool usable() const { return hull_.empty(); }
  grid::CellRect hull() const { return hull_; }

 private:
  grid::CellRect hull_;
};

class ExactBound;

class ExactTable {
 public:
  using Decreases = DecreaseAnywhere;
  using Bound = ExactBound;
  using Entry = CompactCost;

  // Bytes of a table; of one while it is made.
  static std::size_t bytesFor(const grid::GridGeometry& geometry);
  static std::size_t makingBytesFor(const grid::GridGeometry& geometry);

  // Throws Stopped. Where costs overflow every bound is 0.
  ExactTable(const costmap::CostGrid& map, const base::StopToken& stop);

  // The costs to `goal`, by index, in unit(goal).
  const Entry* costsTo(std::uint32_t goal) const { return &costs_[std::size_t{goal} * cells_]; }
  const CompactCostUnit& unit(std::uint32_t goal) const { return units_[goal]; }
  std::size_t bytes() const {
    return costs_.size() * sizeof(Entry) + units_.size() * sizeof(CompactCostUnit);
  }

 private:
  // False where a cost does not fit.
  bool write(const std::vector<SearchKey>& costs, std::size_t goal);

  std::size_t cells_;
  base::ZeroedArray<Entry> costs_;
  std::vector<CompactCostUnit> units_;
};

// The bound to one goal, as keys of a scale.
class ExactBound {
 public:
  // `table` outlives the bound.
  ExactBound(const ExactTable& table, const DecreaseAnywhere&, std::uint32_t goal,
             const KeyScale& scale = kWideScale)
      : costs_(table.costsTo(goal)), unit_(table.unit(goal)), scale_(scale) {}

  SearchKey operator()(std::uint32_t index) const {
    return costs_[index] == kNoCompactCost ? kInfiniteKey : unit_.keyOf(costs_[index], scale_);
  }

 private:
  const ExactTable::Entry* costs_;
  CompactCostUnit unit_;
  KeyScale scale_;
};

}  // namespace grid_path_planner::planners
