// SIMD neighbourhood: eight cells side by side with their neighbours, without bounds checks,
// processed together where the machine has instructions for it.
//
//   forEachEight(map, rect, stop,
//                [&](std::size_t index, int number, const SimdNeighbourhood& cells) {
//                  storeBytes(rules.allowed(cells), number, masks.data() + index);  // steps.h
//                });
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planners {

constexpr int kSimdCells = 8;

class SimdNeighbourhood {
 public:
  // A number a cell; of comparisons all bits or none.
  using Eight = std::uint16_t __attribute__((vector_size(16)));

  // They point to the first cell's column in its row and those around it; the weights from the
  // column before to the one after the eight may be read.
  SimdNeighbourhood(const costmap::CostGrid::Weight* below, const costmap::CostGrid::Weight* at,
                    const costmap::CostGrid::Weight* above)
      : rows_{below, at, above} {}

  // Of the neighbours at an offset of columns and rows, each -1, 0 or 1.
  Eight weights(int columns, int rows) const {
    Eight eight;
    std::memcpy(&eight, rows_[static_cast<std::size_t>(rows) + 1] + columns, sizeof eight);
    return eight;
  }
  Eight blocked(int columns, int rows) const {
    return reinterpret_cast<Eight>(weights(columns, rows) == costmap::CostGrid::kBlocked);
  }
  // Whether all eight neighbours have the weight of the cell.
  Eight alike() const {
    const Eight middle = weights(0, 0);
    Eight alike = ~Eight{};
    for (int rows = -1; rows <= 1; ++rows)
      for (int columns = -1; columns <= 1; ++columns)
        alike &= reinterpret_cast<Eight>(weights(columns, rows) == middle);
    return alike;
  }

 private:
  std::array<const costmap::CostGrid::Weight*, 3> rows_;
};

// Whether it is true of all eight.
inline bool all(const SimdNeighbourhood::Eight& comparison) {
  using Halves = std::uint64_t __attribute__((vector_size(16)));
  const auto halves = reinterpret_cast<Halves>(comparison);
  return (halves[0] & halves[1]) == ~std::uint64_t{0};
}

// The first `number` of values below 256.
inline void storeBytes(const SimdNeighbourhood::Eight& values, int number, std::uint8_t* to) {
  using Bytes = std::uint8_t __attribute__((vector_size(8)));
  const Bytes bytes = __builtin_convertvector(values, Bytes);
  if (number == kSimdCells)
    std::memcpy(to, &bytes, sizeof bytes);
  else
    for (int i = 0; i < number; ++i) to[i] = bytes[i];
}

// Calls visit(index, number, cells) for up to eight cells side by side at a time, for all cells of
// `rect`, row by row. Outside the map all is blocked. Precondition: `rect` lies in the map. Throws Stopped.
template <class Visit>
void forEachEight(const costmap::CostGrid& map, const grid::CellRect& rect,
                  const base::StopToken& stop, const Visit& visit) {
  using Weight = costmap::CostGrid::Weight;
  const grid::Grid<Weight>& weights = map.weights();
  base::StopPoll poll(stop, 64);
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    const bool inside = row > 0 && row + 1 < weights.height();
    std::size_t index = map.geometry().index({rect.column, row}).value();
    for (int done = 0; done < rect.width; done += kSimdCells, index += kSimdCells) {
      const int column = rect.column + done;
      const int number = std::min(kSimdCells, rect.width - done);
      if (inside && column > 0 && column + kSimdCells < weights.width()) {
        const Weight* at = weights.row(row) + column;
        visit(index, number, SimdNeighbourhood(at - weights.width(), at, at + weights.width()));
        continue;
      }
      std::array<std::array<Weight, kSimdCells + 2>, 3> around{};
      const grid::CellRect known =
          grid::CellRect{column - 1, row - 1, kSimdCells + 2, 3}.intersection(
              map.geometry().rect());
      for (int i = known.row; i < known.row + known.height; ++i)
        std::copy_n(weights.row(i) + known.column, known.width,
                    &around[static_cast<std::size_t>(i - row) + 1]
                           [static_cast<std::size_t>(known.column - column) + 1]);
      visit(index, number, SimdNeighbourhood(&around[0][1], &around[1][1], &around[2][1]));
    }
  }
}

}  // namespace grid_path_planner::planners
