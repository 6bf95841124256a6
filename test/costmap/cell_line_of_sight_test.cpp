// Between centres the fast functions give the same as the general ones, to the last bit.

#include <gtest/gtest.h>

#include <random>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "support/cost_maps.h"
#include "support/random_map.h"

namespace grid_path_planner::costmap {

using base::StopToken;
using grid::Cell;
using grid::Grid;
using grid::GridGeometry;

namespace {

void expectTheSame(const CostGrid& map, Cell from, Cell to, int& legal) {
  const SegmentPoint a = SegmentPoint::centreOf(from), b = SegmentPoint::centreOf(to);
  const bool expected = lineOfSight(map, a, b);
  ASSERT_EQ(lineOfSight(map.bitMaps(StopToken()), from, to, map.segmentRule()), expected);
  const std::optional<double> cost = lineCostWithin(map, from, to);
  ASSERT_EQ(cost.has_value(), expected);
  if (!expected) return;
  ++legal;
  ASSERT_EQ(*cost, lineCost(map, a, b));
  EXPECT_EQ(lineCostWithin(map, from, to, *cost), cost);
  EXPECT_FALSE(*cost > 0.0 && lineCostWithin(map, from, to, *cost * (1.0 - 1e-9) - 1e-5));
}

TEST(CellLineOfSightLaw, EqualsTheGeneralOne) {
  std::mt19937 random(2010);
  int legal = 0;
  for (int trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    MotionModel motion;
    motion.cut_corners = trial % 4 == 0;
    CostGrid map = test::randomCosts(random, trial % 3 == 0 ? 150 : 16, motion);
    if (trial % 2 == 1) map.setKeptDistances({0.5, -1.0, 0.0});
    for (int i = 0; i < 60; ++i) {
      const Cell from = test::randomCell(random, map.geometry());
      const Cell near{from.column + static_cast<int>(random() % 13) - 6,
                      from.row + static_cast<int>(random() % 13) - 6};
      const bool local = i % 2 == 0 && map.geometry().contains(near);
      const Cell to = local ? near : test::randomCell(random, map.geometry());
      if (map.passable(from)) expectTheSame(map, from, to, legal);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(legal, 3000);
}

TEST(CellLineOfSightLaw, EqualsTheGeneralOneOverLongLines) {
  std::mt19937 random(64);
  int legal = 0;
  for (int trial = 0; trial < 80; ++trial) {
    Grid<CostGrid::Weight> weights(GridGeometry(300, 200, 1.0), 1);
    for (int i = 0; i < 300; ++i) weights[test::randomCell(random, weights.geometry())] = 0;
    CostGrid map = test::costMap(weights);
    if (trial % 2 == 1) map.setKeptDistances({0.5, -1.0, 0.0});
    for (int i = 0; i < 60; ++i) {
      const Cell from = test::randomCell(random, map.geometry());
      const Cell to = test::randomCell(random, map.geometry());
      if (map.passable(from)) expectTheSame(map, from, to, legal);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(legal, 500);
}

}  // namespace
}  // namespace grid_path_planner::costmap
