#include "path/zigzags.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "support/ascii_map.h"
#include "support/cost_maps.h"
#include "support/random_map.h"

namespace grid_path_planner::path {

using base::StopToken;
using costmap::CostGrid;
using costmap::SegmentPoint;
using Eigen::Vector2d;
using grid::Cell;

namespace {

using Points = std::vector<SegmentPoint>;

// As smoothed() gives it where nothing can be left out.
SmoothPath asItIs(const CostGrid& map, const Points& points) {
  SmoothPath path;
  for (std::size_t i = 0; i < points.size(); ++i) {
    path.kept.push_back(i);
    if (i > 0) path.cost += costmap::lineCost(map, points[i - 1], points[i]);
  }
  return path;
}

SmoothPath calmOver(const CostGrid& map, const Points& points) {
  return withoutZigzags(map, points, asItIs(map, points), StopToken());
}

Points cellCentresOf(const std::vector<Cell>& cells) {
  Points points;
  for (const Cell cell : cells) points.push_back(SegmentPoint::centreOf(cell));
  return points;
}

Vector2d cellsOf(SegmentPoint point) {
  return Vector2d(point.x, point.y) / SegmentPoint::kUnitsPerCell;
}

// The middle of a passage that rises by one cell in three, where weights are least.
const std::vector<std::string> kStaircase = {"3333333222",  //
                                             "3333222333",  //
                                             "3222333333",  //
                                             "2333333333"};
const std::vector<Cell> kAlongIt = {{0, 3}, {1, 2}, {3, 2}, {4, 1}, {6, 1}, {7, 0}, {9, 0}};

TEST(Zigzags, AStaircaseOfWeightsBecomesALine) {
  const CostGrid map = test::costMap(kStaircase);
  const SmoothPath calm = calmOver(map, cellCentresOf(kAlongIt));
  EXPECT_EQ(calm.kept, (std::vector<std::size_t>{0, 6}));
  EXPECT_GT(calm.cost, asItIs(map, cellCentresOf(kAlongIt)).cost);
}

TEST(Zigzags, WeightsThatNoRoundingExplainsAreGoneAround) {
  std::vector<std::string> steep = kStaircase;
  for (std::string& row : steep) std::replace(row.begin(), row.end(), '3', '9');
  EXPECT_GT(calmOver(test::costMap(steep), cellCentresOf(kAlongIt)).kept.size(), 2u);
}

TEST(Zigzags, ABendThatIsNoZigzagStays) {
  const CostGrid map = test::costMap({"33333333",  //
                                      "32222223",  //
                                      "22333322"});
  const std::vector<Cell> bend = {{0, 2}, {1, 1}, {6, 1}, {7, 2}};
  EXPECT_EQ(calmOver(map, cellCentresOf(bend)).kept.size(), bend.size());
}

TEST(Zigzags, AnObstacleOnTheLineIsGoneAround) {
  std::vector<std::string> blocked = kStaircase;
  blocked[2][4] = blocked[1][5] = '#';
  blocked[1][4] = '2';
  const std::vector<Cell> round = {{0, 3}, {1, 2}, {3, 2}, {3, 1}, {4, 0}, {9, 0}};
  const CostGrid map = test::costMap(blocked);
  for (std::size_t i = 1; i < round.size(); ++i)
    ASSERT_TRUE(costmap::lineOfSight(map, SegmentPoint::centreOf(round[i - 1]),
                                     SegmentPoint::centreOf(round[i])));
  const SmoothPath calm = calmOver(map, cellCentresOf(round));
  for (std::size_t i = 1; i < calm.kept.size(); ++i)
    EXPECT_TRUE(costmap::lineOfSight(map, SegmentPoint::centreOf(round[calm.kept[i - 1]]),
                                     SegmentPoint::centreOf(round[calm.kept[i]])));
}

TEST(Zigzags, OneWeightHasNothingToRound) {
  const CostGrid map = test::costMap({"..........", "..........", "..........", ".........."});
  EXPECT_EQ(calmOver(map, cellCentresOf(kAlongIt)).kept.size(), kAlongIt.size());
  EXPECT_EQ(calmOver(map, cellCentresOf({{3, 2}})).kept, std::vector<std::size_t>{0});
}

// All points of a round trip lie on the line of no length between its ends.
TEST(Zigzags, ARoundTripStays) {
  const CostGrid map = test::costMap(kStaircase);
  const std::vector<Cell> there_and_back = {{0, 3}, {1, 2}, {3, 2}, {4, 1}, {3, 2}, {1, 2}, {0, 3}};
  const SmoothPath calm = calmOver(map, cellCentresOf(there_and_back));
  EXPECT_GT(calm.kept.size(), 2u);
  EXPECT_GT(calm.cost, 4.0);
}

TEST(Zigzags, StopsWhenAsked) {
  Points points;
  for (int column = 0; column < 400; ++column)
    points.push_back(SegmentPoint::centreOf({column, column % 2}));
  const CostGrid map =
      test::costMap({std::string(400, '2'), std::string(200, '3') + std::string(200, '2')});
  base::StopSource source;
  source.cancel();
  EXPECT_THROW(withoutZigzags(map, points, asItIs(map, points), source.token()), base::Stopped);
}

// Random walks of legal lines over random weights.
Points randomWalk(std::mt19937& random, const CostGrid& map) {
  Points points = {SegmentPoint::centreOf(test::randomCell(random, map.geometry()))};
  for (int tries = 0; tries < 200; ++tries) {
    const SegmentPoint last = points.back();
    const Cell cell{
        static_cast<int>(last.x / SegmentPoint::kUnitsPerCell) + 1 + static_cast<int>(random() % 3),
        static_cast<int>(last.y / SegmentPoint::kUnitsPerCell) - 1 +
            static_cast<int>(random() % 3)};
    if (!map.geometry().contains(cell)) continue;
    if (!costmap::lineOfSight(map, last, SegmentPoint::centreOf(cell))) continue;
    points.push_back(SegmentPoint::centreOf(cell));
  }
  return points;
}

double distanceToLine(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  if ((point - from).dot(to - from) <= 0.0) return (point - from).norm();
  if ((point - to).dot(from - to) <= 0.0) return (point - to).norm();
  return Eigen::Hyperplane<double, 2>::Through(from, to).absDistance(point);
}

TEST(ZigzagsLaw, WhatIsLeftOutWasNearAndCostHardlyLess) {
  std::mt19937 random(87);
  int straightened = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const CostGrid map = test::randomCosts(random, 60, {});
    const Points points = randomWalk(random, map);
    if (!std::isfinite(asItIs(map, points).cost)) continue;
    const SmoothPath calm = calmOver(map, points);
    ASSERT_EQ(calm.kept.front(), 0u);
    ASSERT_EQ(calm.kept.back(), points.size() - 1);
    double cost = 0.0;
    for (std::size_t i = 1; i < calm.kept.size(); ++i) {
      const std::size_t from = calm.kept[i - 1], to = calm.kept[i];
      ASSERT_LT(from, to);
      ASSERT_TRUE(costmap::lineOfSight(map, points[from], points[to])) << "trial " << trial;
      const double line = costmap::lineCost(map, points[from], points[to]);
      cost += line;
      if (to == from + 1) continue;
      ++straightened;
      double before = (cellsOf(points[to]) - cellsOf(points[from])).norm();
      for (std::size_t p = from + 1; p <= to; ++p) {
        before += costmap::lineCost(map, points[p - 1], points[p]);
        EXPECT_LE(distanceToLine(cellsOf(points[p]), cellsOf(points[from]), cellsOf(points[to])),
                  1.0 + 1e-9);
      }
      EXPECT_LE(line, before * (1.0 + 1e-9)) << "trial " << trial;
    }
    EXPECT_NEAR(cost, calm.cost, 1e-9 * (1.0 + cost));
  }
  EXPECT_GT(straightened, 100);
}

}  // namespace
}  // namespace grid_path_planner::path
