// What weighted_jump_point precomputes of a map: the steps worth taking at every cell, and where
// straight jumps end.
//
//   WeightedJumpMap jumps;
//   jumps.build(map, stop);
//   {
//     const WeightedJumpMap::ScopedGoal scoped_goal(jumps, map, goal);
//     NaturalMoves steps = jumps.steps(map, index);  // without those into dead branches
//     if (!jumps.deadEnd<kEast>(cell)) use(jumps.straightJump<kEast>(cell, weights).to);
//   }
//
// Dead branches: a step after which the natural steps all end within kDepth steps is worth taking
// only if the goal is one of the cells that it leads to. steps() leaves it out; a ScopedGoal puts
// back, while it lives, the steps that lead to the goal. On the slopes of inflation nearly all
// branches uphill are dead, so that jumps along a slope need not stop at every cell.
//
// A cell is a stop of a straight step d where the steps after d are not d alone: the path may turn
// there, or no step leads on. planners/jump_point/straight_jump_table.h holds the stops.
//
// An edit recomputes the cells within kDepth of it, and the dead ends of their rows and columns;
// nothing else.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/natural_moves.h"
#include "planners/jump_point/straight_jump_table.h"

namespace grid_path_planner::planners {

class WeightedJumpMap {
 public:
  static constexpr int kDepth = 12;

  static std::size_t bytesFor(const grid::GridGeometry& geometry);

  // Throw Stopped. `changed`: the cells whose weights changed since.
  void build(const costmap::CostGrid& map, const base::StopToken& stop);
  void update(const costmap::CostGrid& map, const grid::CellRect& changed,
              const base::StopToken& stop);

  // The five bytes of a cell that a search reads together.
  class Mark {
   public:
    std::uint8_t reached;   // of the search: steps that reached the cell at its g-value
    std::uint8_t expanded;  // of the search: those of them that were expanded
    std::uint8_t live;      // steps that do not begin a dead branch

    // Cells with the same natural steps have the same number. There are 65535 numbers; the natural
    // steps of a cell without one are computed when they are needed.
    unsigned naturalId() const { return natural_id_[0] | unsigned(natural_id_[1]) << 8; }
    void setNaturalId(unsigned id) {
      natural_id_ = {static_cast<std::uint8_t>(id & 255U), static_cast<std::uint8_t>(id >> 8)};
    }

   private:
    std::array<std::uint8_t, 2> natural_id_;
  };
  Mark& mark(std::uint32_t index) { return marks_[index]; }
  const Mark& mark(std::uint32_t index) const { return marks_[index]; }

  NaturalMoves natural(const costmap::CostGrid& map, std::uint32_t index) const {
    const unsigned id = marks_[index].naturalId();
    if (id != kNoId) return natural_of_id_[id];
    return naturalMoves(windowAt(map, map.geometry().cell(grid::CellIndex(index))));
  }
  // The natural steps without those into dead branches.
  NaturalMoves steps(const costmap::CostGrid& map, std::uint32_t index) const {
    return natural(map, index) & (marks_[index].live * kEveryByte);
  }

  // Whether the nine cells around have one weight and the cell is not the goal of a ScopedGoal.
  bool open(grid::Cell cell) const {
    return bitOf(rows_.word(std::size_t(cell.row), unsigned(cell.column)).open, cell.column);
  }
  // Whether the straight jump by the step reaches nothing.
  template <unsigned kStep>
  bool deadEnd(grid::Cell cell) const {
    return kStep % 2 == 0
               ? rows_.deadEnd<kStep / 2 == 0>(std::size_t(cell.row), unsigned(cell.column))
               : columns_.deadEnd<kStep / 2 == 0>(std::size_t(cell.column), unsigned(cell.row));
  }
  // Where the straight jump by the step ends, and the sum of max(weight, weight) over its steps.
  // Precondition: the step is legal.
  struct Jump {
    grid::Cell to;
    std::uint64_t weights;
  };
  template <unsigned kStep>
  Jump straightJump(grid::Cell cell, const costmap::CostGrid::Weight* weights) const;

  // While one lives, every jump stops at the goal and no step that leads to it is left out.
  class ScopedGoal {
   public:
    ScopedGoal(WeightedJumpMap& jumps, const costmap::CostGrid& map, grid::Cell goal);
    ~ScopedGoal();
    ScopedGoal(const ScopedGoal&) = delete;
    ScopedGoal& operator=(const ScopedGoal&) = delete;

   private:
    struct Change {
      grid::Cell cell;
      std::uint8_t live;  // before
    };
    void restoreStepsTo(grid::Cell cell, unsigned dead);

    WeightedJumpMap& jumps_;
    const costmap::CostGrid& map_;
    grid::Cell goal_;
    bool was_open_;
    std::vector<Change> changes_;
  };

 private:
  static constexpr unsigned kOpenId = 0;     // the nine cells around have one weight
  static constexpr unsigned kBlockedId = 1;  // no step is natural
  static constexpr unsigned kNoId = 65535;
  static constexpr std::uint64_t kEveryByte = 0x0101010101010101U;

  static bool bitOf(std::uint64_t word, int at) { return (word >> (unsigned(at) & 63U) & 1U) != 0; }
  void setOpen(grid::Cell cell, bool open);
  void computeNaturalIds(const costmap::CostGrid& map, const grid::CellRect& rect,
                         const base::StopToken& stop);
  void computeLiveSteps(const costmap::CostGrid& map, const grid::CellRect& rect,
                        const base::StopToken& stop);
  void buildStops(const costmap::CostGrid& map, const base::StopToken& stop);
  template <bool kForward>
  void buildStopsOf(const costmap::CostGrid& map, grid::Cell cell);
  void setStops(grid::Cell cell, NaturalMoves steps);
  template <bool kForward>
  void setStopsOf(grid::Cell cell, NaturalMoves steps);
  unsigned idOf(NaturalMoves steps);

  int width_ = 0;
  StraightJumpTable rows_;
  StraightJumpTable columns_;
  std::vector<Mark> marks_;
  std::vector<NaturalMoves> natural_of_id_;
  std::unordered_map<NaturalMoves, unsigned> id_of_natural_;
};

template <unsigned kStep>
WeightedJumpMap::Jump WeightedJumpMap::straightJump(
    grid::Cell cell, const costmap::CostGrid::Weight* weights) const {
  constexpr bool kForward = kStep / 2 == 0;
  const auto column = unsigned(cell.column), row = unsigned(cell.row);
  if (kStep % 2 == 0) {
    const costmap::CostGrid::Weight* line = weights + std::size_t(row) * unsigned(width_);
    const StraightJumpTable::Jump jump = rows_.straightJump<kForward>(row, column, line, 1);
    return {{int(jump.to), cell.row}, jump.weights};
  }
  const StraightJumpTable::Jump jump =
      columns_.straightJump<kForward>(column, row, weights + column, width_);
  return {{cell.column, int(jump.to)}, jump.weights};
}

}  // namespace grid_path_planner::planners
