// The bits of every cell are those that walking cell by cell gives, and after any edits those of a
// fresh build.
#include "planners/jump_point/jump_point_bits.h"

#include <gtest/gtest.h>

#include <random>

#include "support/random_map.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::BitMaps;
using costmap::CostGrid;
using grid::Cell;
using grid::CellIndex;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;

namespace {

using Weights = Grid<CostGrid::Weight>;

Weights blockedWith(std::mt19937& random, int width, int height, double share) {
  Weights weights(GridGeometry(width, height, 1.0), 1);
  std::bernoulli_distribution blocked(share);
  for (auto& weight : weights.values())
    if (blocked(random)) weight = CostGrid::kBlocked;
  return weights;
}

bool passable(const Weights& weights, Cell cell) {
  return weights.contains(cell) && weights[cell] != CostGrid::kBlocked;
}

Cell beside(Cell cell, int step) {
  return {cell.column + kSteps[step].column, cell.row + kSteps[step].row};
}

// Whether the cell after `before` by `step` is a jump point of that step.
bool jumpPointAfter(const Weights& weights, Cell before, int step) {
  const Cell cell = beside(before, step);
  if (!passable(weights, cell)) return false;
  for (const int side : {(step + 1) % 4, (step + 3) % 4})
    if (!passable(weights, beside(before, side)) && passable(weights, beside(cell, side)))
      return true;
  return false;
}

struct Stop {
  Cell cell;
  bool jump_point;
};

Stop stopBeyond(const Weights& weights, Cell cell, int step) {
  while (true) {
    const bool jump_point = jumpPointAfter(weights, cell, step);
    cell = beside(cell, step);
    if (jump_point || !passable(weights, cell)) return {cell, jump_point};
  }
}

bool diagonalStepAllowed(const Weights& weights, Cell from, int step) {
  const Cell to = beside(from, step);
  return passable(weights, to) && passable(weights, {from.column, to.row}) &&
         passable(weights, {to.column, from.row});
}

DiagonalJumpBits::Stop diagonalStopBeyond(const Weights& weights, Cell cell, int step) {
  const int horizontal = kSteps[step].column > 0 ? 0 : 2;
  const int vertical = kSteps[step].row > 0 ? 1 : 3;
  for (int steps = 1; true; ++steps) {
    if (!diagonalStepAllowed(weights, cell, step)) return {steps, false, false};
    cell = beside(cell, step);
    const bool horizontal_branch = stopBeyond(weights, cell, horizontal).jump_point;
    const bool vertical_branch = stopBeyond(weights, cell, vertical).jump_point;
    if (horizontal_branch || vertical_branch) return {steps, horizontal_branch, vertical_branch};
  }
}

template <int step>
void expectTrueDiagonally(const JumpPointBits& jump_points, const Weights& weights, Cell cell) {
  const DiagonalJumpBits::Stop stop = jump_points.diagonalStop<step>(cell);
  const DiagonalJumpBits::Stop walked = diagonalStopBeyond(weights, cell, step);
  ASSERT_EQ(stop.steps, walked.steps) << cell << " step " << step;
  ASSERT_EQ(stop.horizontal, walked.horizontal) << cell << " step " << step;
  ASSERT_EQ(stop.vertical, walked.vertical) << cell << " step " << step;
}

// Of some 500 cells: every one of a small map.
void expectTrue(const JumpPointBits& jump_points, const Weights& weights) {
  const std::size_t stride = 1 + weights.values().size() / 500;
  for (std::size_t i = 0; i < weights.values().size(); i += stride) {
    const Cell cell = weights.geometry().cell(CellIndex(static_cast<std::uint32_t>(i)));
    if (!passable(weights, cell)) continue;
    for (int step = 0; step < 4; ++step) {
      const Stop stop = stopBeyond(weights, cell, step);
      ASSERT_EQ(jump_points.leadsToJumpPoint(step, cell), stop.jump_point)
          << cell << " step " << step;
      ASSERT_EQ(jump_points.firstStop(step, cell), step % 2 == 0 ? stop.cell.column : stop.cell.row)
          << cell << " step " << step;
    }
    expectTrueDiagonally<4>(jump_points, weights, cell);
    expectTrueDiagonally<5>(jump_points, weights, cell);
    expectTrueDiagonally<6>(jump_points, weights, cell);
    expectTrueDiagonally<7>(jump_points, weights, cell);
  }
}

TEST(JumpPointBits, AgreeWithWalkingCellByCell) {
  std::mt19937 random(1);
  for (const int width : {1, 2, 7, 63, 64, 65, 150})
    for (const int height : {1, 5, 64, 131})
      for (const double share : {0.0, 0.01, 0.1, 0.4}) {
        const Weights weights = blockedWith(random, width, height, share);
        JumpPointBits jump_points;
        jump_points.build(BitMaps(weights, StopToken()), StopToken());
        expectTrue(jump_points, weights);
      }
}

TEST(JumpPointBits, EqualAFreshBuildAfterEdits) {
  std::mt19937 random(2);
  for (const double share : {0.001, 0.02, 0.3}) {
    Weights weights = blockedWith(random, 210, 170, share);
    BitMaps bits(weights, StopToken());
    JumpPointBits jump_points;
    jump_points.build(bits, StopToken());
    for (int edit = 0; edit < 150; ++edit) {
      const Cell low = test::randomCell(random, weights.geometry());
      const int side = edit % 3 == 0 ? 80 : 3;
      const CellRect changed =
          CellRect{low.column, low.row, 1 + int(random() % side), 1 + int(random() % side)}
              .intersection(weights.geometry().rect());
      std::bernoulli_distribution blocked(share);
      for (int row = changed.row; row < changed.row + changed.height; ++row)
        for (int column = changed.column; column < changed.column + changed.width; ++column)
          weights[Cell{column, row}] = blocked(random) ? CostGrid::kBlocked : 1;
      bits.update(weights, changed, StopToken());
      jump_points.update(bits, changed, StopToken());
      JumpPointBits fresh;
      fresh.build(bits, StopToken());
      ASSERT_TRUE(jump_points == fresh) << "share " << share << " edit " << edit;
    }
  }
}

TEST(JumpPointBits, TakeTheBytesTheyReport) {
  std::mt19937 random(3);
  const Weights weights = blockedWith(random, 300, 200, 0.2);
  JumpPointBits jump_points;
  jump_points.build(BitMaps(weights, StopToken()), StopToken());
  EXPECT_EQ(jump_points.bytes(), JumpPointBits::bytesFor(weights.geometry()));
}

}  // namespace
}  // namespace grid_path_planner::planners
