// What weighted_jump_point computes of a map, once for each tile that a search comes to: the steps
// worth taking at every cell, and where straight jumps end.
//
//   WeightedJumpMap jumps;
//   jumps.reset(map);
//   {
//     const WeightedJumpMap::ScopedGoal scoped_goal(jumps, map, goal);
//     jumps.makeReady(map, cell);
//     NaturalMoves steps = jumps.steps(map, index);  // without those into dead branches
//     if (!jumps.deadEnd<kEast>(map, cell)) use(jumps.straightJump<kEast>(cell, weights).to);
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
// Tiles of 64x64 cells are made ready when they are first needed: most searches come to a part of
// the map, and nothing waits for the rest. A tile depends on the cells within kDepth of it. The
// steps and jumps are the same whatever tiles were made before, so a search goes the same path on
// a new map as later. Around an edit tiles are repaired, or given up where much of them changed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

#include "base/zeroed_array.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/natural_moves.h"
#include "planners/jump_point/dead_ends.h"
#include "planners/jump_point/straight_jump_table.h"
#include "planners/jump_point/window_cache.h"

namespace grid_path_planner::planners {

class TileStops;

// Thrown where a ScopedLimit forbids another tile.
struct TooManyTiles {};

class WeightedJumpMap {
 public:
  static constexpr int kDepth = 12;
  static constexpr int kTile = 64;

  static std::size_t bytesFor(const grid::GridGeometry& geometry);

  // No tile is ready.
  void reset(const costmap::CostGrid& map);
  // `changed`: the cells whose weights changed since. Throws Stopped.
  void update(const costmap::CostGrid& map, const std::vector<grid::CellRect>& changed,
              const base::StopToken& stop);

  // Makes the tile of the cell ready, or the tiles that meet the rectangle.
  [[gnu::cold]] void makeReady(const costmap::CostGrid& map, grid::Cell cell);
  void makeReady(const costmap::CostGrid& map, const grid::CellRect& rect);
  // Makes all tiles ready. Throws Stopped; the tiles that are made stay.
  void makeAllReady(const costmap::CostGrid& map, const base::StopToken& stop);
  std::size_t tilesReady() const { return tiles_ready_; }
  bool allReady() const { return tiles_ready_ == tile_ready_.size(); }

  // While one lives, at most `most` tiles are made, which each take tens of microseconds; then what
  // needs another one throws TooManyTiles, and Stopped where it is to stop.
  class ScopedLimit {
   public:
    ScopedLimit(WeightedJumpMap& jumps, const base::StopToken& stop, std::uint64_t most)
        : jumps_(jumps) {
      jumps_.stop_ = &stop;
      jumps_.tiles_left_ = most;
    }
    ~ScopedLimit() { jumps_.stop_ = nullptr; }
    ScopedLimit(const ScopedLimit&) = delete;
    ScopedLimit& operator=(const ScopedLimit&) = delete;

   private:
    WeightedJumpMap& jumps_;
  };

  // The five bytes of a cell that a search reads together.
  class Mark {
   public:
    std::uint8_t reached;   // of the search: steps that reached the cell at its g-value
    std::uint8_t expanded;  // of the search: those of them that were expanded
    std::uint8_t live;      // steps that do not begin a dead branch

    // Cells with the same natural steps have the same number. There are kNoId numbers; the natural
    // steps of a cell without one are computed when they are needed.
    unsigned naturalId() const { return (bits_[0] | unsigned(bits_[1]) << 8) & kNoId; }
    void setNaturalId(unsigned id) {
      bits_ = {static_cast<std::uint8_t>(id & 255U),
               static_cast<std::uint8_t>(id >> 8 | (bits_[1] & 128U))};
    }
    bool ready() const { return (bits_[1] & 128U) != 0; }
    void setReady(bool ready) {
      bits_[1] = static_cast<std::uint8_t>((bits_[1] & 127U) | (ready ? 128U : 0U));
    }

   private:
    std::array<std::uint8_t, 2> bits_;
  };
  Mark& mark(std::uint32_t index) { return marks_[index]; }
  const Mark& mark(std::uint32_t index) const { return marks_[index]; }

  NaturalMoves natural(const costmap::CostGrid& map, std::uint32_t index) const {
    const unsigned id = marks_[index].naturalId();
    if (id != kNoId) return natural_of_id_[id];
    return naturalMoves(windowAt(map, map.geometry().cell(grid::CellIndex(index))));
  }
  // The natural steps without those into dead branches. Precondition: ready(index).
  NaturalMoves steps(const costmap::CostGrid& map, std::uint32_t index) const {
    return natural(map, index) & (marks_[index].live * kEveryByte);
  }

  // Whether the cell's tile is ready.
  bool ready(std::uint32_t index) const { return marks_[index].ready(); }

  // Whether the nine cells around have one weight and the cell is not the goal of a ScopedGoal;
  // false while the tile is not ready.
  bool open(grid::Cell cell) const {
    return bitOf(rows_.word(std::size_t(cell.row), unsigned(cell.column)).open, cell.column);
  }
  // Whether the straight jump by the step reaches nothing. Makes the tiles up to its end ready.
  // Precondition: the cell's tile is ready.
  template <unsigned kStep>
  bool deadEnd(const costmap::CostGrid& map, grid::Cell cell) {
    const StraightJumpTable::End end = endOf<kStep>(cell);
    if (__builtin_expect(end == StraightJumpTable::End::UNKNOWN, 0))
      return findEnd<kStep>(map, cell);
    return end == StraightJumpTable::End::DEAD;
  }
  // Where the straight jump by the step ends, and the sum of max(weight, weight) over its steps.
  // Precondition: the step is legal, and deadEnd() was asked for it.
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
    bool was_open_ = false;
    std::vector<Change> changes_;
  };

 private:
  using Bits = StraightJumpTable::Bits;
  using End = StraightJumpTable::End;

  static constexpr int kBlock = 16;          // natural steps are computed by blocks of cells
  static constexpr unsigned kOpenId = 0;     // the nine cells around have one weight
  static constexpr unsigned kBlockedId = 1;  // no step enters the cell
  static constexpr unsigned kNoId = 32767;
  static constexpr std::uint64_t kEveryByte = 0x0101010101010101U;

  static bool bitOf(std::uint64_t word, int at) { return (word >> (unsigned(at) & 63U) & 1U) != 0; }
  void setOpen(grid::Cell cell, bool open);
  std::uint8_t& tileReady(grid::Cell cell) {
    return tile_ready_[std::size_t(cell.row / kTile) * tile_columns_ + cell.column / kTile];
  }
  std::uint8_t& blockReady(grid::Cell cell) {
    return block_ready_[std::size_t(cell.row / kBlock) * block_columns_ + cell.column / kBlock];
  }

  // Of a tile, or of a part of it
  void makeTile(const costmap::CostGrid& map, const grid::CellRect& tile);
  void giveUpTiles(const costmap::CostGrid& map, const std::vector<grid::CellRect>& changed);
  void giveUpTile(const costmap::CostGrid& map, const grid::CellRect& tile);
  void repair(const costmap::CostGrid& map, const grid::CellRect& part,
              const grid::CellRect& changed);
  void computeNaturalIds(const costmap::CostGrid& map, const grid::CellRect& rect);
  void computeNaturalIdsOf(const costmap::CostGrid& map, const grid::CellRect& block);
  template <class Eights>
  unsigned naturalIdOf(const Eights& around, int cell);
  void computeLiveSteps(const costmap::CostGrid& map, const grid::CellRect& rect);
  void addStops(const costmap::CostGrid& map, const grid::CellRect& tile, TileStops& stops);
  void writeTile(const costmap::CostGrid& map, const grid::CellRect& tile, const TileStops& stops);
  template <bool kForward>
  void writeStopsOf(const costmap::CostGrid& map, const grid::CellRect& tile,
                    const TileStops& stops);

  // Of stops and ends
  template <unsigned kStep>
  End endOf(grid::Cell cell) const {
    return kStep % 2 == 0
               ? rows_.end<kStep / 2 == 0>(std::size_t(cell.row), unsigned(cell.column))
               : columns_.end<kStep / 2 == 0>(std::size_t(cell.column), unsigned(cell.row));
  }
  template <unsigned kStep>
  [[gnu::cold, gnu::noinline]] bool findEnd(const costmap::CostGrid& map, grid::Cell cell);
  template <unsigned kStep>
  End endAt(const costmap::CostGrid& map, grid::Cell cell);
  void setStops(grid::Cell cell, NaturalMoves steps);
  template <bool kForward>
  void setStopsOf(grid::Cell cell, NaturalMoves steps);
  unsigned idOf(NaturalMoves steps);

  int width_ = 0;
  std::size_t tile_columns_ = 0;
  std::size_t block_columns_ = 0;
  const base::StopToken* stop_ = nullptr;  // of the ScopedLimit, while one lives
  std::uint64_t tiles_left_ = 0;           // for it
  std::size_t tiles_ready_ = 0;
  grid::Cell goal_{-1, -1};  // of the ScopedGoal, while one lives
  StraightJumpTable rows_;
  StraightJumpTable columns_;
  base::ZeroedArray<Mark> marks_;
  std::vector<std::uint8_t> tile_ready_;   // not 0 where it is
  std::vector<std::uint8_t> block_ready_;  // not 0 where the natural steps are computed
  std::vector<NaturalMoves> natural_of_id_;
  std::unordered_map<NaturalMoves, unsigned> id_of_natural_;
  WindowCache windows_;
  DeadBranches branches_;
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
