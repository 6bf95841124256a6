#include "planners/tables/landmark_table.h"

#include <gtest/gtest.h>

#include <random>

#include "planners/tables/exact_table.h"
#include "planners/tables/precomputed_table.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planners {

using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::CostGrid;
using costmap::ExactCost;
using grid::Cell;
using grid::CellIndex;
using grid::CellRect;
using grid::Grid;

namespace {

SearchKey searchKeyOf(const ExactCost& cost) {
  return static_cast<SearchKey>(cost.straight) * kStraightKey +
         static_cast<SearchKey>(cost.diagonal) * kDiagonalKey;
}

std::uint32_t drawPassable(std::mt19937& random, const CostGrid& map) {
  for (int i = 0; i < 1000; ++i) {
    const Cell cell = test::randomCell(random, map.geometry());
    if (map.passable(cell)) return map.geometry().index(cell).value();
  }
  return 0;
}

// `map` with some cells of a random rectangle, which is given too, weighing something else.
CostGrid edited(std::mt19937& random, const CostGrid& map, CellRect& changed) {
  const Cell low = test::randomCell(random, map.geometry());
  changed = CellRect{low.column, low.row, 4, 3}.intersection(map.geometry().rect());
  Grid<CostGrid::Weight> weights = map.weights();
  for (int row = changed.row; row < changed.row + changed.height; ++row)
    for (int column = changed.column; column < changed.column + changed.width; ++column)
      weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 4);
  return CostGrid(weights, map.classes(), map.motion());
}

template <class Bound>
void expectBounds(const Bound& bound, const CostGrid& map, std::uint32_t goal) {
  const auto costs = test::referenceCosts(map, map.geometry().cell(CellIndex(goal)));
  EXPECT_EQ(bound(goal), 0U);
  for (std::uint32_t i = 0; i < costs.size(); ++i)
    if (costs[i]) {
      ASSERT_LE(bound(i), searchKeyOf(*costs[i])) << "from " << map.geometry().cell(CellIndex(i));
    }
}

TEST(LandmarkTable, BoundsAreNoLargerThanTheCost) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const CostGrid map = test::randomCosts(random, 24, {});
    const LandmarkTable table(map, 1 + trial % 20, StopToken());
    const std::uint32_t goal = drawPassable(random, map);
    expectBounds(LandmarkBound(table, {}, goal), map, goal);
  }
}

// To a landmark the bound is the cost, in 32 bits as in 64.
TEST(LandmarkTable, KnowsTheCostsOfItsLandmarks) {
  std::mt19937 random(2);
  int narrow = 0, wide = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const CostGrid map = test::randomCosts(random, 24, {});
    const LandmarkTable table(map, 4, StopToken());
    const CostDecreases unchanged;
    EXPECT_FALSE(table.landmarks().empty());
    for (const Cell landmark : table.landmarks()) {
      const std::uint32_t goal = map.geometry().index(landmark).value();
      const LandmarkBound bound(table, unchanged, goal);
      const LandmarkBound medium(table, unchanged, goal, kMediumScale);
      const auto costs = test::referenceCosts(map, landmark);
      for (std::uint32_t i = 0; i < costs.size(); ++i) {
        if (!costs[i]) continue;
        EXPECT_EQ(bound(i), searchKeyOf(*costs[i]));
        EXPECT_EQ(exactCostOf(medium(i), kMediumScale), *costs[i]);
      }
    }
    ++(table.wide() ? wide : narrow);
  }
  EXPECT_GT(narrow, 0);
  EXPECT_GT(wide, 0);
}

// From 1.1e7 on.
TEST(LandmarkTable, HasNoLandmarksWhereCostsFitNeither) {
  Grid<CostGrid::Weight> weights(grid::GridGeometry(300, 300, 1.0), 65535);
  const auto shared = test::costsOf(weights);
  const CostGrid& map = *shared;
  const LandmarkTable table(map, 8, StopToken());
  EXPECT_TRUE(table.landmarks().empty());
  expectBounds(LandmarkBound(table, {}, 12345), map, 12345);
}

TEST(LandmarkTable, SameMapSameTable) {
  std::mt19937 random(3);
  const CostGrid map = test::randomCosts(random, 40, {});
  const LandmarkTable a(map, 8, StopToken());
  const LandmarkTable b(map, 8, StopToken());
  EXPECT_EQ(a.landmarks(), b.landmarks());
  for (std::uint32_t i = 0; i < map.geometry().size(); ++i)
    for (int k = 0; k < a.stride(); ++k) EXPECT_EQ(a.entry(i, k), b.entry(i, k));
}

TEST(LandmarkTable, TheFirstLiesAtAnEnd) {
  const CostGrid map = test::costMap({std::string(30, '.')});
  const LandmarkTable table(map, 2, StopToken());
  ASSERT_EQ(table.landmarks().size(), 2U);
  EXPECT_EQ(table.landmarks().front().column % 29, 0);
}

TEST(LandmarkTable, StopsWhenAsked) {
  std::mt19937 random(4);
  const CostGrid map = test::randomCosts(random, 200, {});
  StopSource stop;
  stop.cancel();
  EXPECT_THROW(LandmarkTable(map, 16, stop.token()), Stopped);
  EXPECT_THROW(ExactTable(map, stop.token()), Stopped);
}

// One change after the other, with the table of the first map and the cost decreases since,
// while increases need no record.
TEST(CostDecreases, BoundsStayBoundsWhileTheMapChanges) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 60; ++trial) {
    CostGrid map = test::randomCosts(random, 30, {});
    const LandmarkTable table(map, 6, StopToken());
    CostDecreases decreases;
    for (int change = 0; change < 8; ++change) {
      CellRect changed;
      CostGrid next = edited(random, map, changed);
      const CellRect rect = costDecreases(map, next, changed);
      map = std::move(next);
      if (!rect.empty()) decreases.add(table, map.geometry(), rect);
      const std::uint32_t goal = drawPassable(random, map);
      if (map.passable(map.geometry().cell(CellIndex(goal))))
        expectBounds(LandmarkBound(table, decreases, goal), map, goal);
    }
  }
}

TEST(CostDecreases, AreFoundBetweenTwoMaps) {
  const CostGrid before = test::costMap({"555555",  //
                                         "5555#5",  //
                                         "555555",  //
                                         "555555",  //
                                         "555555"});
  const CellRect all = before.geometry().rect();
  const CostGrid increased = test::costMap({"655555",  //
                                            "5555#5",  //
                                            "555555",  //
                                            "5#5555",  //
                                            "555555"});
  EXPECT_TRUE(costDecreases(before, increased, all).empty());
  const CostGrid both = test::costMap({"655555",  //
                                       "5555?5",  //
                                       "554555",  //
                                       "5#5555",  //
                                       "555555"});
  EXPECT_EQ(costDecreases(before, both, all), (CellRect{2, 1, 3, 2}));
  EXPECT_EQ(costDecreases(before, both, (CellRect{0, 2, 6, 3})), (CellRect{2, 2, 1, 1}));
}

TEST(ExactTable, BoundsAreTheCost) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 30; ++trial) {
    const CostGrid map = test::randomCosts(random, 16, {});
    const ExactTable table(map, StopToken());
    const std::uint32_t goal = drawPassable(random, map);
    if (!map.passable(map.geometry().cell(CellIndex(goal)))) continue;
    const ExactBound bound(table, {}, goal);
    expectBounds(bound, map, goal);
    const auto costs = test::referenceCosts(map, map.geometry().cell(CellIndex(goal)));
    for (std::uint32_t i = 0; i < costs.size(); ++i) {
      if (costs[i])
        EXPECT_GE(static_cast<double>(bound(i)),
                  0.999999 * static_cast<double>(searchKeyOf(*costs[i])));
      else
        EXPECT_TRUE(bound(i) == kInfiniteKey || !map.passable(map.geometry().cell(CellIndex(i))));
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
