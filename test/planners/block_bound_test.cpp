// The bound of the blocks, against Boost.Graph's least costs.
#include "planners/tables/block_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::DiagonalCost;
using costmap::MotionModel;
using costmap::stepAllowed;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using test::cellsOf;
using test::costMap;

namespace {

MotionModel motionInTurn(int trial) {
  return {trial / 8 % 2 == 0 ? Connectivity::EIGHT : Connectivity::FOUR,
          trial / 2 % 2 == 0 ? DiagonalCost::SQRT2 : DiagonalCost::UNIT, trial / 4 % 2 == 0};
}

CostGrid costsInTurn(int trial, std::mt19937& random) {
  const GridGeometry geometry(1 + int(random() % 70), 1 + int(random() % 50), 1.0);
  return trial % 3 == 0 ? test::randomPotential(random, geometry, motionInTurn(trial))
                        : test::randomCosts(random, geometry, motionInTurn(trial));
}

SearchKey keyInScale(const costmap::ExactCost& cost, const KeyScale& scale) {
  return SearchKey(cost.straight) * scale.straight + SearchKey(cost.diagonal) * scale.diagonal;
}

Cell openCellOf(std::mt19937& random, const CostGrid& map) {
  Cell cell = test::randomCell(random, map.geometry());
  for (int i = 0; i < 99 && !map.passable(cell); ++i)
    cell = test::randomCell(random, map.geometry());
  return cell;
}

// By a look at every cell.
CostGrid::Weight leastOf(const CostGrid& map, const CellRect& block) {
  CostGrid::Weight least = CostGrid::kBlocked;
  const CellRect cells = block.intersection(map.geometry().rect());
  for (int row = cells.row; row < cells.row + cells.height; ++row)
    for (int column = cells.column; column < cells.column + cells.width; ++column) {
      const CostGrid::Weight weight = map.weight({column, row});
      if (weight != CostGrid::kBlocked && (least == CostGrid::kBlocked || weight < least))
        least = weight;
    }
  return least;
}

// All blocks of the map and those around it. The sum tells whether one changed.
std::uint64_t expectLeastWeights(const CostGrid& map, const BlockWeights& blocks) {
  const int side = blocks.side();
  std::uint64_t sum = 0;
  for (int row = -side; row < map.geometry().height() + side; row += side)
    for (int column = -side; column < map.geometry().width() + side; column += side) {
      // The node at the block's upper right corner.
      const auto node = std::uint32_t((row / side + 1) * int(blocks.stride()) + column / side + 1);
      const CostGrid::Weight least = leastOf(map, {column, row, side, side});
      EXPECT_EQ(blocks.below(node), least) << Cell{column, row};
      sum = sum * 31 + least;
    }
  return sum;
}

TEST(BlockWeightsLaw, AreTheLeastOfTheirCellsAfterEditsToo) {
  std::mt19937 random(37);
  int unchanged = 0;
  for (int trial = 0; trial < 60; ++trial) {
    CostGrid map = costsInTurn(trial, random);
    BlockWeights blocks(trial % 2 == 0 ? 4 : 8);
    blocks.prepare(map, StopToken());
    std::uint64_t sum = expectLeastWeights(map, blocks);
    for (int edit = 0; edit < 8; ++edit) {
      Grid<CostGrid::Weight> weights = map.weights();
      const Cell cell = test::randomCell(random, map.geometry());
      const CellRect changed =
          CellRect{cell.column, cell.row, 1 + int(random() % 3), 1 + edit}.intersection(
              map.geometry().rect());
      for (int row = changed.row; row < changed.row + changed.height; ++row)
        for (int i = 0; i < changed.width; ++i)
          weights[Cell{changed.column + i, row}] = CostGrid::Weight(random() % 60);
      const CostGrid edited = costMap(weights, map.motion());
      const bool any = blocks.update(edited, changed);
      const std::uint64_t before = sum;
      sum = expectLeastWeights(edited, blocks);
      ASSERT_EQ(any, sum != before) << "trial " << trial << ", " << changed.column;
      unchanged += !any;
      map = edited;
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(unchanged, 20);
}

// Never above the least cost, in any scale that holds it; infinite only where no path leads. No step
// changes it by more than it costs, but for the rounding of keys.
TEST(BlockBoundLaw, IsAConsistentLowerBoundInEveryMotionModel) {
  std::mt19937 random(20261122);
  for (int trial = 0; trial < 400; ++trial) {
    const CostGrid map = costsInTurn(trial, random);
    const Cell goal = openCellOf(random, map);
    if (!map.passable(goal)) continue;
    const auto least = test::referenceCosts(map, goal);
    BlockBounds bounds(trial % 2 == 0 ? 4 : 8);
    bounds.prepare(map, StopToken());
    const StopToken never;
    const BlockEstimate bound(bounds.to(goal), kWideScale, never);
    EXPECT_EQ(bound(goal), 0U);
    for (const Cell cell : cellsOf(map)) {
      if (!map.passable(cell)) continue;
      const auto& cost = least[map.geometry().index(cell).value()];
      if (!cost) continue;
      ASSERT_LE(bound(cell), keyInScale(*cost, kWideScale)) << "trial " << trial << ", " << cell;
      for (int step = 0; step < 9; ++step) {
        const Cell to{cell.column + step % 3 - 1, cell.row + step / 3 - 1};
        if (to == cell || !map.passable(to) || !stepAllowed(map, cell, to)) continue;
        const SearchKey length = to.column == cell.column || to.row == cell.row
                                     ? kWideScale.straight
                                     : diagonalKey(kWideScale, map.motion().diagonal_cost);
        ASSERT_LE(bound(cell), bound(to) + length * std::max(map.weight(cell), map.weight(to)) + 1)
            << "trial " << trial << ", " << cell << " to " << to;
      }
    }
  }
}

// A segment is at least cos 22.5 degrees as long as the steps between its ends, so that many times
// the bound holds for segments at any angle.
TEST(BlockBoundLaw, HoldsForSegmentsButForTheirShorterLength) {
  std::mt19937 random(8);
  int legal = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const GridGeometry geometry(1 + int(random() % 70), 1 + int(random() % 50), 1.0);
    const CostGrid map = trial % 2 == 0 ? test::randomPotential(random, geometry, MotionModel())
                                        : test::randomCosts(random, geometry, MotionModel());
    const Cell goal = openCellOf(random, map);
    if (!map.passable(goal)) continue;
    BlockBounds bounds(trial % 4 < 2 ? 4 : 8);
    bounds.prepare(map, StopToken());
    const StopToken never;
    const BlockEstimate bound(bounds.to(goal), kLabelScale, never);
    const auto to = costmap::SegmentPoint::centreOf(goal);
    for (const Cell cell : cellsOf(map)) {
      const auto from = costmap::SegmentPoint::centreOf(cell);
      if (!map.passable(cell) || !costmap::lineOfSight(map, from, to)) continue;
      ++legal;
      const double least = std::cos(M_PI / 8) * double(bound(cell)) / double(kLabelScale.straight);
      ASSERT_LE(least, costmap::lineCost(map, from, to) + 1e-9)
          << "trial " << trial << ", " << cell;
    }
  }
  EXPECT_GT(legal, 2000);
}

// However far other questions made the search go, and with the bounds of other goals between.
TEST(BlockBoundLaw, DependsOnTheMapAndTheGoalAlone) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const CostGrid map = costsInTurn(trial, random);
    BlockBounds bounds(trial % 2 == 0 ? 4 : 8);
    bounds.prepare(map, StopToken());
    std::vector<Cell> goals;
    for (int i = 0; i < 6; ++i) goals.push_back(openCellOf(random, map));
    for (int i = 0; i < 200; ++i) {
      const Cell goal = goals[random() % goals.size()], cell = openCellOf(random, map);
      if (!map.passable(goal) || !map.passable(cell)) continue;
      BlockBounds fresh(trial % 2 == 0 ? 4 : 8);
      fresh.prepare(map, StopToken());
      ASSERT_EQ(bounds.to(goal).at(cell, StopToken()), fresh.to(goal).at(cell, StopToken()));
    }
  }
}

// What is known without searching on is never more than what the search would find.
TEST(BlockBoundLaw, IsNoLessThanWhatIsKnownOfIt) {
  std::mt19937 random(7);
  int less = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const CostGrid map = costsInTurn(trial, random);
    const Cell goal = openCellOf(random, map), start = openCellOf(random, map);
    if (!map.passable(goal) || !map.passable(start)) continue;
    BlockBounds known(trial % 2 == 0 ? 4 : 8), all(known.side());
    known.prepare(map, StopToken());
    all.prepare(map, StopToken());
    BlockBound& bound = known.to(goal);
    ASSERT_EQ(bound.at(start, StopToken()), all.to(goal).at(start, StopToken()));
    const std::uint64_t expanded = bound.expanded();
    for (const Cell cell : cellsOf(map)) {
      if (!map.passable(cell)) continue;
      const std::uint64_t whole = all.to(goal).at(cell, StopToken());
      ASSERT_LE(bound.known(cell), whole) << "trial " << trial << ", " << cell;
      less += bound.known(cell) < whole;
    }
    EXPECT_EQ(bound.expanded(), expanded);
  }
  EXPECT_GT(less, 100);
}

TEST(BlockBoundLaw, AfterEditsIsThatOfAFreshMap) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 40; ++trial) {
    auto map = std::make_shared<const CostGrid>(costsInTurn(trial, random));
    BlockBounds edited(trial % 2 == 0 ? 4 : 8);
    edited.prepare(*map, StopToken());
    Grid<CostGrid::Weight> weights = map->weights();
    for (int edit = 0; edit < 6; ++edit) {
      const std::vector<CellRect> changed =
          grid::disjointRects(test::randomRects(random, map->geometry(), 12));
      std::vector<CellRect> inside;
      for (const CellRect& rect : changed) {
        inside.push_back(rect.intersection(map->geometry().rect()));
        for (int row = inside.back().row; row < inside.back().row + inside.back().height; ++row)
          for (int i = 0; i < inside.back().width; ++i)
            weights[Cell{inside.back().column + i, row}] =
                static_cast<CostGrid::Weight>(random() % 30);
      }
      map = test::costsOf(weights, map->motion(), map->revision() + 1);
      edited.update(*map, inside);
      BlockBounds fresh(trial % 2 == 0 ? 4 : 8);
      fresh.prepare(*map, StopToken());
      const Cell goal = openCellOf(random, *map);
      if (!map->passable(goal)) continue;
      for (const Cell cell : cellsOf(*map))
        if (map->passable(cell)) {
          ASSERT_EQ(edited.to(goal).at(cell, StopToken()), fresh.to(goal).at(cell, StopToken()));
        }
    }
  }
}

// Between two walls every cell weighs 5 or more, and one far away weighs 1: the octile distance at
// that weight is a fifth of the cost, the bound nearly all of it.
TEST(BlockBound, KnowsWhatCellsCostWhereTheOctileDistanceDoesNot) {
  Grid<CostGrid::Weight> weights(GridGeometry(200, 40, 1.0), 5);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 200; ++column)
      weights[Cell{column, row}] = static_cast<CostGrid::Weight>(5 + std::abs(row - 20));
  weights[Cell{199, 39}] = 1;
  const CostGrid map = costMap(weights);
  BlockBounds bounds(8);
  bounds.prepare(map, StopToken());
  const StopToken never;
  const BlockEstimate bound(bounds.to({4, 20}), kWideScale, never);
  const SearchKey cost = SearchKey{180} * 5 * kWideScale.straight;
  EXPECT_GE(bound({184, 20}), cost - cost / 20);
  EXPECT_LE(bound({184, 20}), cost);
}

TEST(BlockBound, IsInfiniteWhereBlockedBlocksPart) {
  Grid<CostGrid::Weight> weights(GridGeometry(100, 30, 1.0), 3);
  for (int row = 0; row < 30; ++row)
    for (int column = 40; column < 60; ++column) weights[Cell{column, row}] = CostGrid::kBlocked;
  const CostGrid map = costMap(weights);
  BlockBounds bounds(8);
  bounds.prepare(map, StopToken());
  EXPECT_EQ(bounds.to({5, 5}).at({90, 5}, StopToken()), BlockBound::kInfinite);
  EXPECT_NE(bounds.to({5, 5}).at({20, 5}, StopToken()), BlockBound::kInfinite);
}

// Weights whose costs reach the end of the values.
TEST(BlockBound, StaysBelowCostsThatItsValuesDoNotHold) {
  const CostGrid map = costMap(Grid<CostGrid::Weight>(GridGeometry(3000, 9, 1.0), 65535));
  BlockBounds bounds(8);
  bounds.prepare(map, StopToken());
  const StopToken never;
  const BlockEstimate bound(bounds.to({0, 4}), kWideScale, never);
  const SearchKey cost = SearchKey{2999} * 65535 * kWideScale.straight;
  EXPECT_LE(bound({2999, 4}), cost);
  EXPECT_GE(bound({2999, 4}), cost / 16);
}

}  // namespace
}  // namespace grid_path_planner::planners
