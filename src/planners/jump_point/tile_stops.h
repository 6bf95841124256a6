// What a tile of 64x64 cells adds to the straight jump tables of its rows and columns, as bits:
// filled cell by cell, written line by line (planners/jump_point/weighted_jump_map.h).
#pragma once

#include <array>
#include <cstdint>

#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/natural_moves.h"

namespace grid_path_planner::planners {

struct TileStops {
  using Bits = std::uint64_t;
  using Lines = std::array<Bits, 64>;

  std::array<Lines, 4> stop{};  // by step; the lines of steps 0 and 2 are rows
  std::array<Lines, 4> dead{};
  Lines row_change{};
  Lines column_change{};
  Lines open{};  // of rows

  // The bits of a line of `length` cells in the tile that lie beyond it.
  static Bits beyond(int length) { return length == 64 ? 0 : ~Bits{0} << unsigned(length); }

  // A cell that is no pass for every step. `steps`: those worth taking there.
  void add(grid::Cell cell, NaturalMoves steps) {
    const unsigned column = unsigned(cell.column) & 63U, row = unsigned(cell.row) & 63U;
    for (unsigned step = 0; step < 4; ++step) {
      const unsigned after = steps >> (8 * step) & 255U;
      const unsigned line = step % 2 == 0 ? row : column, at = step % 2 == 0 ? column : row;
      stop[step][line] |= Bits{after != 1U << step} << at;
      dead[step][line] |= Bits{after == 0} << at;
    }
  }

  // Whether the weight changes to the next cell of the row, and to that of the column.
  void addChange(grid::Cell cell, bool along_row, bool along_column) {
    const unsigned column = unsigned(cell.column) & 63U, row = unsigned(cell.row) & 63U;
    row_change[row] |= Bits{along_row} << column;
    column_change[column] |= Bits{along_column} << row;
  }

  void addOpen(grid::Cell cell) {
    open[unsigned(cell.row) & 63U] |= Bits{1} << (unsigned(cell.column) & 63U);
  }
};

}  // namespace grid_path_planner::planners
