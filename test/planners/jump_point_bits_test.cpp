// Jump maps say of every cell what walking cell by cell says, and after any edits what maps made
// anew say.
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

// Whether going on by `step` from `before` one may have to turn at the next cell.
bool turnAfter(const Weights& weights, Cell before, int step) {
  const Cell cell = beside(before, step);
  if (!passable(weights, cell)) return false;
  for (const int side : {(step + 1) % 4, (step + 3) % 4})
    if (!passable(weights, beside(before, side)) && passable(weights, beside(cell, side)))
      return true;
  return false;
}

struct Stop {
  Cell cell;
  bool turn;
};

Stop stopBeyond(const Weights& weights, Cell cell, int step) {
  while (true) {
    const bool turn = turnAfter(weights, cell, step);
    cell = beside(cell, step);
    if (turn || !passable(weights, cell)) return {cell, turn};
  }
}

bool diagonalStepAllowed(const Weights& weights, Cell from, int step) {
  const Cell to = beside(from, step);
  return passable(weights, to) && passable(weights, {from.column, to.row}) &&
         passable(weights, {to.column, from.row});
}

DiagonalJumpBits::Stop diagonalStopBeyond(const Weights& weights, Cell cell, int step) {
  const int side = kSteps[step].column > 0 ? 0 : 2;
  const int height = kSteps[step].row > 0 ? 1 : 3;
  for (int steps = 1; true; ++steps) {
    if (!diagonalStepAllowed(weights, cell, step)) return {steps, false, false};
    cell = beside(cell, step);
    const bool to_side = stopBeyond(weights, cell, side).turn;
    const bool to_height = stopBeyond(weights, cell, height).turn;
    if (to_side || to_height) return {steps, to_side, to_height};
  }
}

template <int step>
void expectTrueDiagonally(const JumpPointBits& maps, const Weights& weights, Cell cell) {
  const DiagonalJumpBits::Stop stop = maps.diagonalStop<step>(cell);
  const DiagonalJumpBits::Stop walked = diagonalStopBeyond(weights, cell, step);
  ASSERT_EQ(stop.steps, walked.steps) << cell << " step " << step;
  ASSERT_EQ(stop.side, walked.side) << cell << " step " << step;
  ASSERT_EQ(stop.height, walked.height) << cell << " step " << step;
}

// Of some 500 cells: every one of a small map.
void expectTrue(const JumpPointBits& maps, const Weights& weights) {
  const std::size_t stride = 1 + weights.values().size() / 500;
  for (std::size_t i = 0; i < weights.values().size(); i += stride) {
    const Cell cell = weights.geometry().cell(CellIndex(static_cast<std::uint32_t>(i)));
    if (!passable(weights, cell)) continue;
    for (int step = 0; step < 4; ++step) {
      const Stop stop = stopBeyond(weights, cell, step);
      ASSERT_EQ(maps.leads(step, cell), stop.turn) << cell << " step " << step;
      ASSERT_EQ(maps.stop(step, cell), step % 2 == 0 ? stop.cell.column : stop.cell.row)
          << cell << " step " << step;
    }
    expectTrueDiagonally<4>(maps, weights, cell);
    expectTrueDiagonally<5>(maps, weights, cell);
    expectTrueDiagonally<6>(maps, weights, cell);
    expectTrueDiagonally<7>(maps, weights, cell);
  }
}

TEST(JumpPointBits, SayWhatWalkingCellByCellSays) {
  std::mt19937 random(1);
  for (const int width : {1, 2, 7, 63, 64, 65, 150})
    for (const int height : {1, 5, 64, 131})
      for (const double share : {0.0, 0.01, 0.1, 0.4}) {
        const Weights weights = blockedWith(random, width, height, share);
        JumpPointBits maps;
        maps.build(BitMaps(weights, StopToken()), StopToken());
        expectTrue(maps, weights);
      }
}

TEST(JumpPointBits, AreAfterEditsAsIfMadeAnew) {
  std::mt19937 random(2);
  for (const double share : {0.001, 0.02, 0.3}) {
    Weights weights = blockedWith(random, 210, 170, share);
    BitMaps bits(weights, StopToken());
    JumpPointBits maps;
    maps.build(bits, StopToken());
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
      maps.update(bits, changed, StopToken());
      JumpPointBits fresh;
      fresh.build(bits, StopToken());
      ASSERT_TRUE(maps == fresh) << "share " << share << " edit " << edit;
    }
  }
}

TEST(JumpPointBits, TakeTheBytesTheySay) {
  std::mt19937 random(3);
  const Weights weights = blockedWith(random, 300, 200, 0.2);
  JumpPointBits maps;
  maps.build(BitMaps(weights, StopToken()), StopToken());
  EXPECT_EQ(maps.bytes(), JumpPointBits::bytesFor(weights.geometry()));
}

}  // namespace
}  // namespace grid_path_planner::planners
