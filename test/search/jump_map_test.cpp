#include "grid_path_planner/search/jump_map.h"

#include <gtest/gtest.h>

#include <random>

#include "grid_path_planner/search/steps.h"
#include "support/random_map.h"

namespace grid_path_planner {
namespace {

// Along a step until the natural steps are not the default ones, cell by cell.
JumpMap::Run slowRun(const CostGrid& map, Cell cell, unsigned step) {
  std::uint64_t weights = 0;
  for (;;) {
    const Cell next{cell.column + kSteps[step].column, cell.row + kSteps[step].row};
    weights += std::max(map.weight(cell), map.weight(next));
    cell = next;
    if ((naturalSteps(windowAt(map, cell)) >> (8 * step) & 255U) == kDefaultSteps[step]) continue;
    return {static_cast<std::uint32_t>(step % 2 == 0 ? cell.column : cell.row), weights};
  }
}

JumpMap::Run fastRun(const JumpMap& jumps, const CostGrid& map, Cell cell, unsigned step) {
  const CostGrid::Weight* weights = map.weights().values().data();
  switch (step) {
    case 0:
      return jumps.alongRow<true>(cell, weights);
    case 1:
      return jumps.alongColumn<true>(cell, weights);
    case 2:
      return jumps.alongRow<false>(cell, weights);
    default:
      return jumps.alongColumn<false>(cell, weights);
  }
}

void expectRight(const JumpMap& jumps, const CostGrid& map, Cell cell) {
  const NaturalSteps natural = naturalSteps(windowAt(map, cell));
  EXPECT_EQ(jumps.natural(map, map.geometry().index(cell).value()), natural);
  for (unsigned step = 0; step < 8; ++step) {
    if (step >= 4) {
      EXPECT_EQ(jumps.stopsDiagonal(cell, int(step)),
                (natural >> (8 * step) & 255U) != kDefaultSteps[step]);
      continue;
    }
    if (!stepAllowed(map, cell, {cell.column + kSteps[step].column, cell.row + kSteps[step].row}))
      continue;
    const JumpMap::Run fast = fastRun(jumps, map, cell, step), slow = slowRun(map, cell, step);
    EXPECT_EQ(fast.to, slow.to) << cell << " step " << step;
    EXPECT_EQ(fast.weights, slow.weights) << cell << " step " << step;
  }
}

void expectRightEverywhere(const JumpMap& jumps, const CostGrid& map) {
  for (int row = 0; row < map.geometry().height(); ++row)
    for (int column = 0; column < map.geometry().width(); ++column)
      expectRight(jumps, map, {column, row});
}

// One row or column of 200 cells: more than three words, and both sides of a word's edge.
TEST(JumpMap, RunsAcrossWords) {
  for (const bool upright : {false, true}) {
    const GridGeometry geometry(upright ? 1 : 200, upright ? 200 : 1, 1.0);
    Grid<CostGrid::Weight> weights(geometry, 3);
    for (const std::uint32_t dear : {62U, 63U, 64U, 127U, 128U, 130U}) weights[CellIndex(dear)] = 9;
    const CostGrid map(weights, Grid<Occupancy>(geometry, Occupancy::FREE), {});
    JumpMap jumps;
    jumps.build(map, StopToken());
    expectRightEverywhere(jumps, map);
    const JumpMap::Run run = fastRun(jumps, map, {0, 0}, upright ? 1 : 0);
    EXPECT_EQ(run.to, 199U);
    EXPECT_EQ(run.weights, 199U * 3 + 9 * 6) << "nine steps touch a dear cell";
  }
}

TEST(JumpMapLaw, RunsAsFarAsTheDefaultStepsAreNatural) {
  std::mt19937 random(31);
  for (int trial = 0; trial < 40; ++trial) {
    const CostGrid map = test::randomCosts(random, trial % 4 == 0 ? 150 : 30, {});
    JumpMap jumps;
    jumps.build(map, StopToken());
    expectRightEverywhere(jumps, map);
  }
}

TEST(JumpMapLaw, AfterEditsIsWhatAFreshOneWouldBe) {
  std::mt19937 random(32);
  for (int trial = 0; trial < 30; ++trial) {
    CostGrid map = test::randomCosts(random, 40, {});
    JumpMap jumps;
    jumps.build(map, StopToken());
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
      jumps.update(map, changed, StopToken());
    }
    expectRightEverywhere(jumps, map);
  }
}

TEST(JumpMap, StopsAtATarget) {
  const GridGeometry geometry(90, 90, 1.0);
  const CostGrid map(Grid<CostGrid::Weight>(geometry, 1),
                     Grid<Occupancy>(geometry, Occupancy::FREE), {});
  JumpMap jumps;
  jumps.build(map, StopToken());
  {
    const JumpMap::Target target(jumps, {70, 20});
    EXPECT_EQ(fastRun(jumps, map, {3, 20}, 0).to, 70U);
    EXPECT_EQ(fastRun(jumps, map, {89, 20}, 2).to, 70U);
    EXPECT_EQ(fastRun(jumps, map, {70, 2}, 1).to, 20U);
    EXPECT_EQ(fastRun(jumps, map, {70, 80}, 3).to, 20U);
    for (int step = 4; step < 8; ++step) EXPECT_TRUE(jumps.stopsDiagonal({70, 20}, step));
  }
  for (const Cell cell : {Cell{70, 20}, Cell{3, 20}, Cell{70, 80}}) expectRight(jumps, map, cell);
}

}  // namespace
}  // namespace grid_path_planner
