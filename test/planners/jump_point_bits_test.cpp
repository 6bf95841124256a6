// The bits of every cell are those that walking cell by cell gives, and after any edits those of a
// fresh build. So is what is counted of a map, which tells mazes, halls and noise apart.
#include "planners/jump_point/jump_point_bits.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "planners/jump_point/jump_point_density.h"
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

// The picture, again and again.
Weights repeated(const std::vector<std::string>& picture, int width, int height) {
  Weights weights(GridGeometry(width, height, 1.0), 1);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const std::string& line = picture[std::size_t(row) % picture.size()];
      if (line[std::size_t(column) % line.size()] == '#')
        weights[Cell{column, row}] = CostGrid::kBlocked;
    }
  return weights;
}

JumpPointDensity::Counts walked(const Weights& weights) {
  JumpPointDensity::Counts counts;
  for (std::uint32_t i = 0; i < weights.values().size(); ++i) {
    const Cell cell = weights.geometry().cell(CellIndex(i));
    if (!passable(weights, cell)) continue;
    ++counts.free;
    for (int step = 0; step < 4; ++step) {
      if (!passable(weights, beside(cell, step))) ++counts.borders;
      const Cell before = beside(cell, (step + 2) % 4);
      if (passable(weights, before) && jumpPointAfter(weights, before, step)) ++counts.jump_points;
    }
  }
  return counts;
}

void expectCounts(const JumpPointDensity& density, const JumpPointDensity::Counts& expected) {
  EXPECT_EQ(density.counts().free, expected.free);
  EXPECT_EQ(density.counts().borders, expected.borders);
  EXPECT_EQ(density.counts().jump_points, expected.jump_points);
}

JumpPointDensity densityOf(const Weights& weights) {
  JumpPointDensity density;
  density.sample(BitMaps(weights, StopToken()), StopToken());
  return density;
}

TEST(JumpPointDensityLaw, CountsWhatWalkingCellByCellFinds) {
  std::mt19937 random(1);
  for (const int width : {1, 2, 63, 65, 100, 130})
    for (const int height : {1, 2, 70, 128}) {
      const Weights weights = blockedWith(random, width, height, 0.3);
      SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
      expectCounts(densityOf(weights), walked(weights));
    }
}

TEST(JumpPointDensityLaw, AfterEditsEqualsAFreshSample) {
  std::mt19937 random(2);
  Weights weights = blockedWith(random, 150, 700, 0.2);
  BitMaps bits(weights, StopToken());
  JumpPointDensity density = densityOf(weights);
  for (int edit = 0; edit < 200; ++edit) {
    const Cell low = test::randomCell(random, weights.geometry());
    const CellRect changed =
        CellRect{low.column, low.row, 1 + int(random() % 40), 1 + int(random() % 40)}.intersection(
            weights.geometry().rect());
    for (int row = changed.row; row < changed.row + changed.height; ++row)
      for (int column = changed.column; column < changed.column + changed.width; ++column)
        weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 2);
    bits.update(weights, changed, StopToken());
    density.update(bits, changed);
    expectCounts(density, densityOf(weights).counts());
    if (HasFailure()) FAIL() << "edit " << edit;
  }
}

TEST(JumpPointDensity, LeavesNoiseToAStar) {
  std::mt19937 random(3);
  for (const double share : {0.03, 0.1, 0.2, 0.35}) {
    const JumpPointDensity density = densityOf(blockedWith(random, 300, 300, share));
    EXPECT_TRUE(density.aStarPays()) << share;
    EXPECT_EQ(density.jumpsPay(), share == 0.35) << share;
  }
}

TEST(JumpPointDensity, TellsNarrowPassagesFromHalls) {
  const Weights narrow = repeated({"####.#####", "..........", ".........."}, 500, 500);
  EXPECT_FALSE(densityOf(narrow).aStarPays());
  EXPECT_TRUE(densityOf(narrow).jumpsPay());
  const Weights halls = repeated(std::vector<std::string>(20, "#..................."), 500, 500);
  EXPECT_FALSE(densityOf(halls).aStarPays());
  EXPECT_FALSE(densityOf(halls).jumpsPay());
  const Weights open = repeated({"."}, 500, 500);
  EXPECT_FALSE(densityOf(open).aStarPays());
  EXPECT_FALSE(densityOf(open).jumpsPay());
}

// Corridors one cell wide: every second row, or every fourth, is a wall.
TEST(JumpPointDensity, IsNotMisledByAMapThatRepeatsItself) {
  const std::vector<std::string> maze{"#########.", "..........", "####.#####", ".........."};
  for (const int height : {128, 256, 512, 1024, 2048})
    EXPECT_TRUE(densityOf(repeated(maze, 200, height)).jumpsPay()) << height;
}

}  // namespace
}  // namespace grid_path_planner::planners
