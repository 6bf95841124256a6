// What weighted_jump_point makes of a map before it searches: the steps worth taking at every cell,
// and how far straight runs go.
//
//   WeightedJumpMap jumps;
//   jumps.build(map, stop);
//   {
//     const WeightedJumpMap::Target target(jumps, map, goal);
//     NaturalMoves steps = jumps.steps(map, index);  // without those into dead branches
//     if (!jumps.blind<kEast>(cell)) WeightedJumpMap::Run run = jumps.run<kEast>(cell, weights);
//   }
//
// Dead branches: a step after which the natural steps all end within kDepth steps leads nowhere
// else, so it is worth taking only where the goal may be among its ends. It is left out, and a
// Target puts back, while it lives, the steps that lead to its cell. Up the slopes around obstacles
// nearly all branches are dead, so that runs along them need not stop at every cell.
//
// A cell is a stop of a straight step d where the steps after d are not d alone: a turn may begin
// there, or nothing leads on. Those are the bits of planners/jump_point/straight_jump_table.h.
//
// An edit recomputes the cells within kDepth of it, and what the rows and columns of these say of
// the runs that end there; nothing else.
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

  // Five bytes of a cell that a search reads together.
  class Mark {
   public:
    std::uint8_t reached;  // the search's own: steps that reached the cell at its least cost so far
    std::uint8_t expanded;  // and those of them after which the steps were taken
    std::uint8_t live;      // steps that do not begin a dead branch

    // Cells whose natural steps are the same are of one kind. There is room for 65535 kinds; the
    // steps of a cell of a further one are computed when asked for.
    unsigned kind() const { return kind_[0] | unsigned(kind_[1]) << 8; }
    void setKind(unsigned kind) {
      kind_ = {static_cast<std::uint8_t>(kind & 255U), static_cast<std::uint8_t>(kind >> 8)};
    }

   private:
    std::array<std::uint8_t, 2> kind_;
  };
  Mark& mark(std::uint32_t index) { return marks_[index]; }
  const Mark& mark(std::uint32_t index) const { return marks_[index]; }

  NaturalMoves natural(const costmap::CostGrid& map, std::uint32_t index) const {
    const unsigned kind = marks_[index].kind();
    if (kind != kUnlisted) return steps_[kind];
    return naturalMoves(windowAt(map, map.geometry().cell(grid::CellIndex(index))));
  }
  // Of these the ones worth taking.
  NaturalMoves steps(const costmap::CostGrid& map, std::uint32_t index) const {
    return natural(map, index) & (marks_[index].live * kEveryByte);
  }

  // Whether all nine cells around weigh the same and runs need not look closer. Not at a target.
  bool open(grid::Cell cell) const {
    return bitOf(rows_.word(std::size_t(cell.row), unsigned(cell.column)).open, cell.column);
  }
  // Whether a run by the straight step finds nothing.
  template <unsigned kStep>
  bool blind(grid::Cell cell) const {
    return kStep % 2 == 0
               ? rows_.deadEnd<kStep / 2 == 0>(std::size_t(cell.row), unsigned(cell.column))
               : columns_.deadEnd<kStep / 2 == 0>(std::size_t(cell.column), unsigned(cell.row));
  }
  // Where a run by the straight step ends, and the sum of max(weight, weight) on the way.
  // Precondition: the step is legal.
  struct Run {
    grid::Cell to;
    std::uint64_t weights;
  };
  template <unsigned kStep>
  Run run(grid::Cell cell, const costmap::CostGrid::Weight* weights) const;

  // While one lives every run stops at its cell and no step towards it is left out.
  class Target {
   public:
    Target(WeightedJumpMap& jumps, const costmap::CostGrid& map, grid::Cell cell);
    ~Target();
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

   private:
    struct Change {
      grid::Cell cell;
      std::uint8_t live;  // before
    };
    void admit(grid::Cell cell, unsigned dead);

    WeightedJumpMap& jumps_;
    const costmap::CostGrid& map_;
    grid::Cell cell_;
    bool open_;
    std::vector<Change> changes_;
  };

 private:
  static constexpr unsigned kOpen = 0;     // kinds: every cell around weighs the same,
  static constexpr unsigned kBlocked = 1;  // nothing is natural,
  static constexpr unsigned kUnlisted = 65535;
  static constexpr std::uint64_t kEveryByte = 0x0101010101010101U;

  static bool bitOf(std::uint64_t word, int at) { return (word >> (unsigned(at) & 63U) & 1U) != 0; }
  void setOpen(grid::Cell cell, bool open);
  void writeKinds(const costmap::CostGrid& map, const grid::CellRect& rect,
                  const base::StopToken& stop);
  void writeLive(const costmap::CostGrid& map, const grid::CellRect& rect,
                 const base::StopToken& stop);
  void writeAllStops(const costmap::CostGrid& map, const base::StopToken& stop);
  template <bool kForward>
  void writeFirstStops(const costmap::CostGrid& map, grid::Cell cell);
  void writeStops(grid::Cell cell, NaturalMoves steps);
  template <bool kForward>
  void writeStopsOf(grid::Cell cell, NaturalMoves steps);
  unsigned kindOf(NaturalMoves steps);

  int width_ = 0;
  StraightJumpTable rows_;
  StraightJumpTable columns_;
  std::vector<Mark> marks_;
  std::vector<NaturalMoves> steps_;  // by kind
  std::unordered_map<NaturalMoves, unsigned> kind_of_;
};

template <unsigned kStep>
WeightedJumpMap::Run WeightedJumpMap::run(grid::Cell cell,
                                          const costmap::CostGrid::Weight* weights) const {
  constexpr bool kForward = kStep / 2 == 0;
  const auto column = unsigned(cell.column), row = unsigned(cell.row);
  if (kStep % 2 == 0) {
    const costmap::CostGrid::Weight* lane = weights + std::size_t(row) * unsigned(width_);
    const StraightJumpTable::Run run = rows_.run<kForward>(row, column, lane, 1);
    return {{int(run.to), cell.row}, run.weights};
  }
  const StraightJumpTable::Run run = columns_.run<kForward>(column, row, weights + column, width_);
  return {{cell.column, int(run.to)}, run.weights};
}

}  // namespace grid_path_planner::planners
