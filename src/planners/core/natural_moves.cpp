#include "planners/core/natural_moves.h"

#include <algorithm>

#include "planners/core/keys.h"
#include "planners/core/steps.h"

namespace grid_path_planner::planners {

using costmap::CostGrid;
using grid::Cell;

namespace {

constexpr int kMiddle = 4;
constexpr int kOutside = 9;

// Integers in doubles, of which the compiler computes two minima at a time. A path inside the window
// has at most eight steps of weight 65535, so the order is exact and sums stay far below 2^53.
constexpr double kStraight = kWindowScale.straight;
constexpr double kDiagonal = kWindowScale.diagonal;
constexpr double kFar = 1e15;

// Diagonal steps come first.
constexpr int rankOf(int step) {
  return (step + 4) & 7;
}

struct Neighbours {
  std::array<std::array<std::uint8_t, 8>, 9> to{};
};

constexpr Neighbours neighboursInside() {
  Neighbours neighbours;
  for (int cell = 0; cell < 9; ++cell)
    for (int step = 0; step < 8; ++step) {
      const int column = cell % 3 + kSteps[step].column;
      const int row = cell / 3 + kSteps[step].row;
      const bool inside = column >= 0 && column < 3 && row >= 0 && row < 3;
      neighbours.to[cell][step] = static_cast<std::uint8_t>(inside ? 3 * row + column : kOutside);
    }
  return neighbours;
}

constexpr Neighbours kInside = neighboursInside();

// Costs of all steps and least costs of all paths inside a window.
class WindowPaths {
 public:
  explicit WindowPaths(const Window& window) {
    for (int from = 0; from < 9; ++from)
      for (int step = 0; step < 8; ++step) steps_[from][step] = costOf(window, from, step);
    for (int from = 0; from < 9; ++from) {
      least_[from].fill(kFar);
      least_[from][from] = 0.0;
      for (int step = 0; step < 8; ++step)
        if (kInside.to[from][step] != kOutside)
          least_[from][kInside.to[from][step]] = steps_[from][step];
    }
    for (int by = 0; by < 9; ++by)
      if (window[by] != CostGrid::kBlocked) lowerBy(by);
    for (int e = 0; e < 8; ++e) {
      const double cost = steps_[kMiddle][e];
      if (cost < kFar && !precededBy(kMiddle, e, kInside.to[kMiddle][e], cost))
        canonical_ |= 1U << e;
    }
  }

  unsigned naturalAfter(int d) const {
    const int from = kInside.to[kMiddle][oppositeStep(static_cast<std::uint32_t>(d))];
    unsigned mask = 0;
    if (steps_[from][d] >= kFar) return 0;
    for (unsigned rest = canonical_; rest != 0; rest &= rest - 1)
      if (canonical(from, d, __builtin_ctz(rest))) mask |= rest & -rest;
    return mask;
  }

 private:
  static double costOf(const Window& window, int from, int step) {
    const int to = kInside.to[from][step];
    if (to == kOutside || window[from] == 0 || window[to] == 0) return kFar;
    const double weight = std::max(window[from], window[to]);
    if (step < 4) return weight * kStraight;
    const int column = from + kSteps[step].column;
    const int row = from + 3 * kSteps[step].row;
    return window[column] == 0 || window[row] == 0 ? kFar : weight * kDiagonal;
  }

  // A path costs the same in both directions.
  void lowerBy(int by) {
    const std::array<double, 9> row = least_[by];
    for (int from = 1; from < 9; ++from)
      for (int to = 0; to < from; ++to) {
        const double cost = row[from] + row[to];
        if (cost < least_[from][to]) least_[from][to] = least_[to][from] = cost;
      }
  }

  // Whether a path of `cost` from `from` to `to` may begin with a step that precedes `step`.
  bool precededBy(int from, int step, int to, double cost) const {
    for (int other = 0; other < 8; ++other) {
      const int by = kInside.to[from][other];
      if (by == kOutside || rankOf(other) >= rankOf(step)) continue;
      if (steps_[from][other] + least_[by][to] <= cost) return true;
    }
    return false;
  }

  // Precondition: the step e is the canonical path by itself.
  bool canonical(int from, int d, int e) const {
    const int to = kInside.to[kMiddle][e];
    const double cost = steps_[from][d] + steps_[kMiddle][e];
    return least_[from][to] >= cost && !precededBy(from, d, to, cost);
  }

  std::array<std::array<double, 8>, 9> steps_;
  std::array<std::array<double, 9>, 9> least_;
  unsigned canonical_ = 0;  // the steps from the middle that no other path to their end precedes
};

}  // namespace

NaturalMoves naturalMoves(const Window& window) {
  if (window[kMiddle] == CostGrid::kBlocked) return 0;
  const WindowPaths paths(window);
  NaturalMoves steps = 0;
  for (int d = 0; d < 8; ++d) steps |= NaturalMoves{paths.naturalAfter(d)} << (8 * d);
  return steps;
}

Window windowAt(const CostGrid& map, Cell cell) {
  Window window;
  const int width = map.geometry().width(), height = map.geometry().height();
  const bool inner =
      cell.column > 0 && cell.column + 1 < width && cell.row > 0 && cell.row + 1 < height;
  for (int row = 0; row < 3; ++row) {
    const int at_row = cell.row + row - 1;
    if (inner) {
      std::copy_n(map.weights().row(at_row) + cell.column - 1, 3, window.begin() + 3 * row);
      continue;
    }
    for (int column = 0; column < 3; ++column) {
      const Cell at{cell.column + column - 1, at_row};
      window[3 * row + column] = map.geometry().contains(at) ? map.weight(at) : CostGrid::kBlocked;
    }
  }
  return window;
}

}  // namespace grid_path_planner::planners
