// The jump points of all cells and directions as bitmaps, computed and repaired 64 cells at a time
// (Harabor & Grastien, "Improving Jump Point Search", ICAPS 2014).
//
//   JumpPointBits jump_points;
//   jump_points.build(map.bitMaps(stop), stop);
//   if (jump_points.leadsToJumpPoint(0, cell)) use(jump_points.firstStop(0, cell));  // its column
//
// A straight jump stops before a blocked cell and at a straight jump point: a free cell with a
// forced neighbour, since an obstacle ends beside it. With p the cell before x, x is one where a
// neighbour beside p is blocked and the one beside x is not (corners are not cut; Harabor &
// Grastien, "The JPS Pathfinding System", SoCS 2012). A diagonal jump stops where the next step is
// not allowed, and where a straight jump that ends at a jump point branches off.
//
// So a straight jump is a search for the next 0 bit in one line of words, and a diagonal one reads
// a word for up to eight steps, where scanning three lines of words for every branch at every step
// would take dozens of instructions. Memory: 20 bits a cell. Directions are numbered as in
// planners/steps.h.
#pragma once

#include <array>
#include <cstddef>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/bit_maps.h"
#include "planners/core/steps.h"
#include "planners/jump_point/diagonal_jump_bits.h"

namespace grid_path_planner::planners {

class JumpPointBits {
 public:
  using Word = costmap::BitMap::Word;

  // Throws Stopped.
  void build(const costmap::BitMaps& free, const base::StopToken& stop);
  // `free` differs from the bits before only inside `changed`. Repairs that rectangle and the cells
  // from which straight jumps lead into it. Throws Stopped.
  void update(const costmap::BitMaps& free, const grid::CellRect& changed,
              const base::StopToken& stop);

  static std::size_t bytesFor(const grid::GridGeometry& geometry);
  std::size_t bytes() const;

  // Whether the straight jump from `cell` by step 0..3 ends at a jump point.
  bool leadsToJumpPoint(int step, grid::Cell cell) const { return leads_[step][cell]; }
  // The column (steps 0, 2) or row (1, 3) of the first stop after `cell`: of a jump point, or of
  // the first blocked cell, which may lie one outside the map.
  int firstStop(int step, grid::Cell cell) const {
    const bool horizontal = step % 2 == 0;
    const Word* line = passes_[step].row(horizontal ? cell.row : cell.column);
    const int from = horizontal ? cell.column : cell.row;
    return step < 2 ? costmap::zeroFrom(line, from + 1) : costmap::zeroBefore(line, from);
  }
  // The first stop after `cell` by the diagonal step 4..7: a cell from which a straight jump leads
  // to a jump point, or one into which the diagonal step is not allowed.
  template <int step>
  DiagonalJumpBits::Stop diagonalStop(grid::Cell cell) const {
    return diagonals_[step - 4].stop<kSteps[step].column, kSteps[step].row>(cell);
  }

  friend bool operator==(const JumpPointBits& a, const JumpPointBits& b) {
    return a.passes_ == b.passes_ && a.leads_ == b.leads_ && a.diagonals_ == b.diagonals_;
  }

 private:
  struct Range {
    int first;
    int last;
  };

  void markStraightStops(const costmap::BitMap& free, int line, int first_word, int last_word,
                         int axis);
  void markRowLeads(const costmap::BitMap& free, int row, int first_word, int last_word);
  void markColumnLeads(const costmap::BitMap& free, int word, int first_block, int last_block);
  void markDiagonalStops(const costmap::BitMap& free, int row, int first_word, int last_word);
  // The cells of a line whose straight jumps pass a cell of `changed`, and `changed` itself.
  Range affectedRange(int axis, int line, Range changed) const;

  // Bit 1: no stop. By straight step; of steps 1 and 3 transposed, so that a row holds a column.
  std::array<costmap::BitMap, 4> passes_;
  // Bit 1: the straight jump ends at a jump point. By straight step, none transposed.
  std::array<costmap::BitMap, 4> leads_;
  std::array<DiagonalJumpBits, 4> diagonals_;  // by diagonal step - 4
};

}  // namespace grid_path_planner::planners
