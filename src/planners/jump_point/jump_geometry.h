// What a jump on a uniform map is measured in: its scale, and the straight steps beside a diagonal one.
#pragma once

#include <cstdint>

#include "grid_path_planner/grid/cell.h"
#include "planners/core/keys.h"
#include "planners/core/steps.h"

namespace grid_path_planner::planners {

// Keys of one cell length and one diagonal, neighbouring convergents of sqrt 2: the order of keys
// below kLargest is that of costs (see costmap/exact_cost.h).
struct SmallScale {
  using Key = std::uint32_t;
  static constexpr Key kStraight = kSmallScale.straight;
  static constexpr Key kDiagonal = kSmallScale.diagonal;
  static constexpr Key kLargest = kSmallScale.largest;
};
struct LargeScale {
  using Key = std::uint64_t;
  static constexpr Key kStraight = kStraightKey;
  static constexpr Key kDiagonal = kDiagonalKey;
  static constexpr Key kLargest = kLargestKey;
};

// The straight steps that a diagonal step is made of.
constexpr int horizontalPart(int diagonal) {
  return kSteps[diagonal].column > 0 ? 0 : 2;
}
constexpr int verticalPart(int diagonal) {
  return kSteps[diagonal].row > 0 ? 1 : 3;
}
constexpr int diagonalBetween(int a, int b) {
  const int horizontal = a % 2 == 0 ? a : b, vertical = a % 2 == 0 ? b : a;
  return vertical == 1 ? (horizontal == 0 ? 4 : 5) : (horizontal == 0 ? 7 : 6);
}

constexpr grid::Cell moved(grid::Cell cell, int step, int times) {
  return {cell.column + times * kSteps[step].column, cell.row + times * kSteps[step].row};
}

}  // namespace grid_path_planner::planners
