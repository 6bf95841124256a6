// One pass over cells with their 3x3 neighbourhoods: nine bits of what is passable, three weights
// read a cell, no bounds looked at.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/terrain/cost_grid.h"

namespace grid_path_planner {

// The bit of the neighbour (columns, rows) away from the middle, each -1, 0 or 1.
constexpr unsigned neighbourBit(int columns, int rows) {
  return static_cast<unsigned>((columns + 1) * 3 + rows + 1);
}

// Of eight cells that lie side by side, handled together where the machine has instructions for it.
struct EightNeighbourhoods {
  using Eight = std::uint16_t __attribute__((vector_size(16)));
  Eight bits = {};
  Eight equal = ~Eight{};  // 0 where not

  // `below`, `at` and `above` point to the first cell's column in its row and those around it.
  EightNeighbourhoods(const std::uint16_t* below, const std::uint16_t* at,
                      const std::uint16_t* above)
      : middle_(from(at)) {
    takeColumn<-1>(below, at, above);
    takeColumn<0>(below, at, above);
    takeColumn<1>(below, at, above);
  }

 private:
  static Eight from(const std::uint16_t* weights) {
    Eight eight;
    std::memcpy(&eight, weights, sizeof eight);
    return eight;
  }
  template <int kColumns>
  void takeColumn(const std::uint16_t* below, const std::uint16_t* at, const std::uint16_t* above) {
    take<neighbourBit(kColumns, -1)>(from(below + kColumns));
    take<neighbourBit(kColumns, 0)>(from(at + kColumns));
    take<neighbourBit(kColumns, 1)>(from(above + kColumns));
  }
  template <unsigned kBit>
  void take(const Eight& weights) {
    bits |= reinterpret_cast<Eight>(weights != 0) & static_cast<std::uint16_t>(1U << kBit);
    equal &= reinterpret_cast<Eight>(weights == middle_);
  }

  Eight middle_;
};

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
  constexpr int kTogether = 8;
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
    std::size_t index = map.geometry().index({rect.column, row}).value();
    int column = rect.column;
    const int end = rect.column + rect.width;
    for (; column > 0 && column < end && column + kTogether < width; column += kTogether) {
      const EightNeighbourhoods eight(below + column, at + column, above + column);
      const int number = std::min(kTogether, end - column);
      for (int i = 0; i < number; ++i, ++index) visit(index, eight.bits[i], eight.equal[i] != 0);
    }
    if (column >= end) continue;
    Column west = columnAt(column - 1), middle = columnAt(column);
    for (; column < end; ++column, ++index) {
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
