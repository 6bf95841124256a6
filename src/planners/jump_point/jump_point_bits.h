// What jump point search wants to know of every cell, as bits that are made and repaired 64 cells
// at a time.
//
//   JumpPointBits maps;
//   maps.build(map.bitMaps(stop), stop);
//   if (maps.leads(0, cell)) use(maps.stop(0, cell));  // the jump point to the east
//
// Going straight, one stops before a cell that is blocked and at a turn: a free cell beside which
// an obstacle ends, so that the shortest way around the obstacle may turn there. With p the cell
// before x, x is a turn where a neighbour beside p is blocked and the one beside x is not
// (corners are not cut; Harabor & Grastien, "The JPS Pathfinding System", SoCS 2012).
// Going diagonally, one stops where the way ends, and where a straight way that leads to a turn
// branches off.
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
#include "grid_path_planner/costmap/bit_scan.h"
#include "grid_path_planner/planners/steps.h"
#include "planners/jump_point/diagonal_jump_bits.h"

namespace grid_path_planner::planners {

class JumpPointBits {
 public:
  using Word = costmap::BitMap::Word;

  // Throws Stopped.
  void build(const costmap::BitMaps& free, const base::StopToken& stop);
  // `free` differs from what was built only inside `changed`, which is repaired, and as far around
  // as straight ways lead into it without a stop. Throws Stopped.
  void update(const costmap::BitMaps& free, const grid::CellRect& changed,
              const base::StopToken& stop);

  static std::size_t bytesFor(const grid::GridGeometry& geometry);
  std::size_t bytes() const;

  // Of the straight steps 0..3: whether the first stop beyond `cell` is a turn.
  bool leads(int step, grid::Cell cell) const { return leads_[step][cell]; }
  // The column (steps 0, 2) or row (1, 3) of the first stop beyond `cell`: of a turn, or of the
  // first blocked cell, which may lie one outside the map.
  int stop(int step, grid::Cell cell) const {
    const bool horizontal = step % 2 == 0;
    const Word* line = go_[step].row(horizontal ? cell.row : cell.column);
    const int from = horizontal ? cell.column : cell.row;
    return step < 2 ? costmap::zeroFrom(line, from + 1) : costmap::zeroBefore(line, from);
  }
  // Of the diagonal steps 4..7: how many steps to the first stop beyond `cell`: a cell from which a
  // straight way leads to a turn, or one into which the diagonal step is not allowed.
  template <int step>
  DiagonalJumpBits::Stop diagonalStop(grid::Cell cell) const {
    return tiles_[step - 4].stop<kSteps[step].column, kSteps[step].row>(cell);
  }

  friend bool operator==(const JumpPointBits& a, const JumpPointBits& b) {
    return a.go_ == b.go_ && a.leads_ == b.leads_ && a.tiles_ == b.tiles_;
  }

 private:
  struct Range {
    int first;
    int last;
  };

  void markStops(const costmap::BitMap& free, int line, int first_word, int last_word, int axis);
  void markRowLeads(const costmap::BitMap& free, int row, int first_word, int last_word);
  void markColumnLeads(const costmap::BitMap& free, int word, int first_block, int last_block);
  void markPasses(const costmap::BitMap& free, int row, int first_word, int last_word);
  // Of a line, the cells that see something of `along` on their straight way, and `along`.
  Range reachOf(int axis, int line, Range along) const;

  // A bit is 1 where one does not stop. By straight step; 1 and 3 transposed, a column a row.
  std::array<costmap::BitMap, 4> go_;
  std::array<costmap::BitMap, 4> leads_;   // by straight step, all row by row
  std::array<DiagonalJumpBits, 4> tiles_;  // by diagonal step - 4
};

}  // namespace grid_path_planner::planners
