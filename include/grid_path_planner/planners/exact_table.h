// The cost between every two cells of a small map: the estimate with which A* goes nowhere else
// than along a cheapest path.
//
// 4 bytes (table_entry.h) for every pair of cells, so twice the cells take four times the memory: a
// map of 100x100 cells 400 MB. On maps whose costs are too dear for exact entries the estimates
// fall short by up to two units, so a search must re-open cells to be optimal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/base/zeroed_array.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planners/compact_cost.h"
#include "grid_path_planner/planners/keys.h"

namespace grid_path_planner::planners {

// Any place that became cheaper makes the table useless.
class CheaperAnywhere {
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
  using Cheaper = CheaperAnywhere;
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
  ExactBound(const ExactTable& table, const CheaperAnywhere&, std::uint32_t goal,
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
