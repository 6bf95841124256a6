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
#include "grid_path_planner/search/search_key.h"
#include "grid_path_planner/search/table_entry.h"
#include "grid_path_planner/terrain/cost_grid.h"

namespace grid_path_planner {

// Any place that became cheaper makes the table useless.
class CheaperAnywhere {
 public:
  template <class Table>
  void add(const Table&, const GridGeometry&, const CellRect& rect) {
    hull_ = hull_.hull(rect);
  }
  bool usable() const { return hull_.empty(); }
  CellRect hull() const { return hull_; }

 private:
  CellRect hull_;
};

class ExactBound;

class ExactTable {
 public:
  using Cheaper = CheaperAnywhere;
  using Bound = ExactBound;
  using Entry = TableEntry;

  // Bytes of a table; of one while it is made.
  static std::size_t bytesFor(const GridGeometry& geometry);
  static std::size_t makingBytesFor(const GridGeometry& geometry);

  // Throws Stopped. Where costs overflow every bound is 0.
  ExactTable(const CostGrid& map, const StopToken& stop);

  // The costs to `goal`, by index, in unit(goal).
  const Entry* costsTo(std::uint32_t goal) const { return &costs_[std::size_t{goal} * cells_]; }
  const TableUnit& unit(std::uint32_t goal) const { return units_[goal]; }
  std::size_t bytes() const {
    return costs_.size() * sizeof(Entry) + units_.size() * sizeof(TableUnit);
  }

 private:
  // False where a cost does not fit.
  bool write(const std::vector<SearchKey>& costs, std::size_t goal);

  std::size_t cells_;
  ZeroedArray<Entry> costs_;
  std::vector<TableUnit> units_;
};

// The bound to one goal, as keys of a scale.
class ExactBound {
 public:
  // `table` outlives the bound.
  ExactBound(const ExactTable& table, const CheaperAnywhere&, std::uint32_t goal,
             const KeyScale& scale = kWideScale)
      : costs_(table.costsTo(goal)), unit_(table.unit(goal)), scale_(scale) {}

  SearchKey operator()(std::uint32_t index) const {
    return costs_[index] == kNoEntry ? kInfiniteKey : unit_.keyOf(costs_[index], scale_);
  }

 private:
  const ExactTable::Entry* costs_;
  TableUnit unit_;
  KeyScale scale_;
};

}  // namespace grid_path_planner
