#include "planners/jump_point/weighted_jump_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planners/core/steps.h"
#include "support/cost_maps.h"
#include "support/random_map.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::CostGrid;
using costmap::stepAllowed;
using grid::Cell;
using grid::CellIndex;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using test::cellsOf;

namespace {

Cell after(Cell cell, unsigned step) {
  return {cell.column + kSteps[step].column, cell.row + kSteps[step].row};
}

NaturalMoves stepsAt(const WeightedJumpMap& jumps, const CostGrid& map, Cell cell) {
  return jumps.steps(map, map.geometry().index(cell).value());
}

WeightedJumpMap::Jump jumpOf(const WeightedJumpMap& jumps, const CostGrid& map, unsigned step,
                             Cell cell) {
  const CostGrid::Weight* weights = map.weights().values().data();
  return step == 0   ? jumps.straightJump<0>(cell, weights)
         : step == 1 ? jumps.straightJump<1>(cell, weights)
         : step == 2 ? jumps.straightJump<2>(cell, weights)
                     : jumps.straightJump<3>(cell, weights);
}

bool deadEndAt(WeightedJumpMap& jumps, const CostGrid& map, unsigned step, Cell cell) {
  return step == 0   ? jumps.deadEnd<0>(map, cell)
         : step == 1 ? jumps.deadEnd<1>(map, cell)
         : step == 2 ? jumps.deadEnd<2>(map, cell)
                     : jumps.deadEnd<3>(map, cell);
}

// Jumps end where following the steps cell by cell ends.
void expectJumpsFollowSteps(WeightedJumpMap& jumps, const CostGrid& map, Cell from) {
  for (unsigned step = 0; step < 4; ++step) {
    if (!stepAllowed(map, from, after(from, step))) continue;
    std::uint64_t weights = 0;
    Cell at = from;
    unsigned steps = 0;
    do {
      const Cell next = after(at, step);
      weights += std::max(map.weight(at), map.weight(next));
      at = next;
      steps = stepsAt(jumps, map, at) >> (8 * step) & 255U;
    } while (steps == kNaturalInTheOpen[step]);
    ASSERT_EQ(deadEndAt(jumps, map, step, from), steps == 0) << from << " step " << step;
    const WeightedJumpMap::Jump jump = jumpOf(jumps, map, step, from);
    ASSERT_EQ(jump.to, at) << from << " step " << step;
    ASSERT_EQ(jump.weights, weights) << from << " step " << step;
  }
}

void expectAlike(WeightedJumpMap& a, WeightedJumpMap& b, const CostGrid& map) {
  a.makeReady(map, map.geometry().rect());
  for (const Cell cell : cellsOf(map)) {
    ASSERT_EQ(a.open(cell), b.open(cell)) << cell;
    ASSERT_EQ(stepsAt(a, map, cell), stepsAt(b, map, cell)) << cell;
    for (unsigned step = 0; step < 4; ++step) {
      if (stepAllowed(map, cell, after(cell, step))) {
        ASSERT_EQ(deadEndAt(a, map, step, cell), deadEndAt(b, map, step, cell))
            << cell << " step " << step;
      }
    }
  }
}

WeightedJumpMap built(const CostGrid& map) {
  WeightedJumpMap jumps;
  jumps.reset(map);
  jumps.makeReady(map, map.geometry().rect());
  return jumps;
}

TEST(WeightedJumpMap, JumpsPastDeadBranchesOfSlopes) {
  // A corridor with expensive cells along its walls: in its middle only the step straight on lives.
  Grid<CostGrid::Weight> weights(GridGeometry(100, 9, 1.0), 1);
  const CostGrid::Weight slope[] = {9, 5, 2, 1, 1, 1, 2, 5, 9};
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 100; ++column) weights[Cell{column, row}] = slope[row];
  const CostGrid map = test::costMap(weights);
  WeightedJumpMap jumps = built(map);
  EXPECT_GE(jumpOf(jumps, map, 0, {20, 6}).to.column, 100 - WeightedJumpMap::kDepth - 5);
  EXPECT_TRUE(deadEndAt(jumps, map, 1, {20, 6})) << "up the slope";
  const WeightedJumpMap::ScopedGoal scoped_goal(jumps, map, {20, 8});
  EXPECT_FALSE(deadEndAt(jumps, map, 1, {20, 6})) << "but the goal is there";
}

TEST(WeightedJumpMapLaw, JumpsFollowTheSteps) {
  std::mt19937 random(31);
  for (int trial = 0; trial < 60; ++trial) {
    const CostGrid map = test::randomCosts(random, trial % 4 == 0 ? 140 : 30, {});
    WeightedJumpMap jumps = built(map);
    for (const Cell cell : cellsOf(map)) expectJumpsFollowSteps(jumps, map, cell);
    if (HasFatalFailure()) FAIL() << "trial " << trial;
  }
}

TEST(WeightedJumpMapLaw, StepsAreNaturalOnes) {
  std::mt19937 random(33);
  for (int trial = 0; trial < 20; ++trial) {
    const CostGrid map = test::randomCosts(random, 30, {});
    const WeightedJumpMap jumps = built(map);
    for (const Cell cell : cellsOf(map)) {
      const NaturalMoves natural = naturalMoves(windowAt(map, cell));
      EXPECT_EQ(jumps.natural(map, map.geometry().index(cell).value()), natural);
      EXPECT_EQ(stepsAt(jumps, map, cell) & ~natural, 0U);
    }
  }
}

TEST(WeightedJumpMapLaw, EqualsAFreshBuildAfterEdits) {
  std::mt19937 random(32);
  for (int trial = 0; trial < 30; ++trial) {
    CostGrid map = test::randomCosts(random, 80, {});
    WeightedJumpMap jumps = built(map);
    for (int edit = 0; edit < 6; ++edit) {
      const Cell low = test::randomCell(random, map.geometry());
      const CellRect changed =
          CellRect{low.column, low.row, 1 + int(random() % 4), 1 + int(random() % 4)}.intersection(
              map.geometry().rect());
      Grid<CostGrid::Weight> weights = map.weights();
      for (int row = changed.row; row < changed.row + changed.height; ++row)
        for (int column = changed.column; column < changed.column + changed.width; ++column)
          weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 4);
      map = CostGrid(weights, map.classes(), map.motion());
      jumps.update(map, {changed}, StopToken());
    }
    WeightedJumpMap fresh = built(map);
    expectAlike(jumps, fresh, map);
    for (const Cell cell : cellsOf(map)) expectJumpsFollowSteps(jumps, map, cell);
    if (HasFatalFailure()) FAIL() << "trial " << trial;
  }
}

CellRect randomRect(std::mt19937& random, const GridGeometry& geometry, int longest) {
  const Cell low = test::randomCell(random, geometry);
  return CellRect{low.column, low.row, 1 + int(random() % longest), 1 + int(random() % longest)}
      .intersection(geometry.rect());
}

// Tiles are made in the order of the questions, and edits come in between: of a few cells, which are
// repaired, and of more than a tile, for which tiles are given up.
TEST(WeightedJumpMapLaw, IsTheSameWhateverTilesWereMadeBefore) {
  std::mt19937 random(35);
  for (int trial = 0; trial < 30; ++trial) {
    Grid<CostGrid::Weight> weights(
        GridGeometry(100 + int(random() % 160), 100 + int(random() % 160), 1.0), 1);
    for (auto& weight : weights.values())
      if (random() % 40 == 0) weight = static_cast<CostGrid::Weight>(random() % 3);
    CostGrid map = test::costMap(weights);
    WeightedJumpMap jumps;
    jumps.reset(map);
    for (int question = 0; question < 60; ++question) {
      const Cell cell = test::randomCell(random, map.geometry());
      jumps.makeReady(map, cell);
      if (map.passable(cell))
        for (unsigned step = 0; step < 4; ++step)
          if (stepAllowed(map, cell, after(cell, step))) deadEndAt(jumps, map, step, cell);
      if (question % 20 != 19) continue;
      std::vector<CellRect> changed;
      for (int i = 0; i < 1 + trial % 6; ++i)
        changed.push_back(randomRect(random, map.geometry(), question % 40 == 19 ? 5 : 120));
      changed = grid::disjointRects(changed);
      for (const CellRect& rect : changed)
        for (int row = rect.row; row < rect.row + rect.height; ++row)
          for (int column = rect.column; column < rect.column + rect.width; ++column)
            weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 4);
      map = test::costMap(weights);
      jumps.update(map, changed, StopToken());
    }
    WeightedJumpMap fresh = built(map);
    expectAlike(jumps, fresh, map);
    if (HasFatalFailure()) FAIL() << "trial " << trial;
  }
}

TEST(WeightedJumpMapLaw, AScopedGoalStopsEveryJumpAndLeavesNoTrace) {
  std::mt19937 random(34);
  for (int trial = 0; trial < 60; ++trial) {
    const CostGrid map = test::randomCosts(random, 60, {});
    WeightedJumpMap fresh = built(map), jumps = built(map);
    for (int query = 0; query < 5; ++query) {
      const Cell goal = test::randomCell(random, map.geometry());
      if (!map.passable(goal)) continue;
      const WeightedJumpMap::ScopedGoal scoped_goal(jumps, map, goal);
      EXPECT_FALSE(jumps.open(goal));
      for (unsigned step = 0; step < 4; ++step) {
        const Cell before{goal.column - kSteps[step].column, goal.row - kSteps[step].row};
        if (!stepAllowed(map, before, goal)) continue;
        EXPECT_EQ(jumpOf(jumps, map, step, before).to, goal);
        EXPECT_FALSE(deadEndAt(jumps, map, step, before));
      }
    }
    expectAlike(jumps, fresh, map);
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
