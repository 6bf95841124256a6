// One pass over cells with their 3x3 neighbourhoods: nine bits of what is passable, three weights
// read a cell, no bounds looked at.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/terrain/cost_grid.h"

namespace grid_path_planner {

// The bit of the neighbour (columns, rows) away from the middle, each -1, 0 or 1.
constexpr unsigned neighbourBit(int columns, int rows) {
  return static_cast<unsigned>((columns + 1) * 3 + rows + 1);
}

// Calls visit(index, bits, equal) for every cell of `rect`, row by row: bit neighbourBit() is set
// where the neighbour is passable, outside the map nothing is; `equal` says whether all nine weigh
// the same. Precondition: `rect` lies in the map. Throws Stopped.
template <class Visit>
void forEachNeighbourhood(const CostGrid& map, const CellRect& rect, const StopToken& stop,
                          Visit&& visit) {
  using Weight = CostGrid::Weight;
  struct Column {
    unsigned bits;
    Weight middle;
    bool equal;
  };
  const int width = map.geometry().width(), height = map.geometry().height();
  const std::vector<Weight> outside(static_cast<std::size_t>(width), CostGrid::kBlocked);
  StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    const Weight* below = row > 0 ? map.weights().row(row - 1) : outside.data();
    const Weight* at = map.weights().row(row);
    const Weight* above = row + 1 < height ? map.weights().row(row + 1) : outside.data();
    const auto columnAt = [&](int column) {
      if (column < 0 || column >= width) return Column{0, CostGrid::kBlocked, false};
      const Weight a = below[column], b = at[column], c = above[column];
      return Column{unsigned(a != 0) | unsigned(b != 0) << 1 | unsigned(c != 0) << 2, b,
                    a == b && b == c};
    };
    Column west = columnAt(rect.column - 1), middle = columnAt(rect.column);
    std::size_t index = map.geometry().index({rect.column, row}).value();
    for (int column = rect.column; column < rect.column + rect.width; ++column, ++index) {
      const Column east = columnAt(column + 1);
      const bool equal = west.equal && middle.equal && east.equal && west.middle == middle.middle &&
                         middle.middle == east.middle;
      visit(index, west.bits | middle.bits << 3 | east.bits << 6, equal);
      west = middle;
      middle = east;
    }
  }
}

}  // namespace grid_path_planner
