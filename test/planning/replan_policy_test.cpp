#include "grid_path_planner/planning/replan_policy.h"

#include <gtest/gtest.h>

#include <random>

#include "support/cost_maps.h"
#include "support/kept_distance.h"
#include "support/random_map.h"

namespace grid_path_planner::planning {

using path::Path;
using test::costsOf;

namespace {

Path through(const std::vector<Eigen::Vector2d>& points) {
  Path path;
  for (const auto& point : points) {
    path.poses.emplace_back();
    path.poses.back().position = {point.x(), point.y(), 0.0};
  }
  return path;
}

TEST(RemainingPath, JoinsAtTheNearestPointAndGoesOn) {
  const Polyline remaining = remainingPath(through({{0, 0}, {4, 0}, {4, 4}}), {2, 1});
  ASSERT_EQ(remaining.size(), 4u);
  EXPECT_EQ(remaining[0], Eigen::Vector2d(2, 1));
  EXPECT_EQ(remaining[1], Eigen::Vector2d(2, 0));
  EXPECT_EQ(remaining[3], Eigen::Vector2d(4, 4));
}

TEST(RemainingPath, OfTwoPointsEquallyNearTheLaterOneIsJoined) {
  const Polyline remaining = remainingPath(through({{0, 0}, {4, 0}, {4, 2}, {0, 2}}), {1, 1});
  ASSERT_EQ(remaining.size(), 3u);
  EXPECT_EQ(remaining[1], Eigen::Vector2d(1, 2));
}

TEST(RemainingPath, OfOnePoseIsTheSegmentToIt) {
  const Polyline remaining = remainingPath(through({{3, 3}}), {1, 1});
  ASSERT_EQ(remaining.size(), 2u);
  EXPECT_EQ(remaining[1], Eigen::Vector2d(3, 3));
}

TEST(CostOf, IsThatOfTheStepsAndNoneThroughObstacles) {
  const auto costs = costsOf({"...", ".#.", "..."});
  EXPECT_DOUBLE_EQ(*costOf({{0.5, 0.5}, {2.5, 0.5}}, *costs), 2.0);
  EXPECT_FALSE(costOf({{0.5, 1.5}, {2.5, 1.5}}, *costs));
  EXPECT_FALSE(costOf({{0.5, 0.5}, {9.5, 0.5}}, *costs)) << "outside the map";
}

// A vehicle that stands 1.3 m from one obstacle may be as near to another for a cell's diagonal, along the segment to its
// path and along the one after it; what comes then keeps the whole radius.
TEST(CostOf, OnlyTheFirstTwoSegmentsMayBeAsNearAsTheStart) {
  costmap::CostmapOptions options;
  options.radius = 1.37;
  options.outside = costmap::Outside::FREE;
  grid::OccupancyGrid map(grid::GridGeometry(20, 20, 1.0), 0);
  map.row(17)[2] = 100;  // at the start
  map.row(9)[4] = 100;   // 1.33 m from the last segment, beside its beginning
  const auto costs = test::costsOf(map, options);
  const Eigen::Vector2d start(2.5, 15.7), joins(2.3, 13.5), turns(2.71, 10.5), end(2.11, 4.5);
  EXPECT_TRUE(costOf({start, joins, turns}, *costs));
  EXPECT_TRUE(costOf({start, turns, end}, *costs));
  EXPECT_FALSE(costOf({start, joins, turns, end}, *costs));
}

TEST(PathBlocked, OnlyWhatRemainsCounts) {
  const auto costs = costsOf({".....", ".#...", "....."});
  const Path path = through({{0.5, 1.5}, {4.5, 1.5}});
  EXPECT_TRUE(pathBlocked(path, Eigen::Vector2d(0.5, 1.5), *costs));
  EXPECT_TRUE(pathBlocked(path, std::nullopt, *costs));
  EXPECT_FALSE(pathBlocked(path, Eigen::Vector2d(2.5, 1.5), *costs)) << "it lies behind";
}

// Long straight runs among obstacles, where a step that is too near must not be lost among others.
TEST(CostOfLaw, ThereIsOneExactlyWhereNoPointIsNearerThanTheRadius) {
  std::mt19937 random(1473);
  int legal = 0, illegal = 0;
  for (int trial = 0; trial < 600; ++trial) {
    costmap::CostmapOptions options;
    options.radius = 1.37;  // not a distance between a centre and a cell
    options.outside = costmap::Outside::FREE;
    const grid::OccupancyGrid map = test::randomOccupancy(random, 60, 0.003, 0.0);
    const auto costs = test::costsOf(map, options);
    Polyline line;
    grid::Cell cell{int(random() % unsigned(map.width())), int(random() % unsigned(map.height()))};
    int columns = 1, rows = 0;
    while (line.size() < 80 && map.geometry().contains(cell)) {
      line.push_back(map.geometry().centre(cell));
      if (random() % 12 == 0) columns = int(random() % 3) - 1, rows = int(random() % 3) - 1;
      cell = {cell.column + columns, cell.row + rows};
    }
    const double at_start = test::leastDistance({line.front()}, map, {}, 9.0);
    if (at_start < options.radius) continue;
    const bool kept = test::leastDistance(line, map, {}, 9.0) >= options.radius;
    EXPECT_EQ(costOf(line, *costs).has_value(), kept) << "trial " << trial;
    ++(kept ? legal : illegal);
  }
  EXPECT_GT(legal, 100);
  EXPECT_GT(illegal, 50);
}

// navigation2 #2381, #2085, navigation #1194: replans flip left and right.
TEST(KeepsPath, WhileTheNewOneIsNotCheaperByTheHysteresis) {
  const auto costs = costsOf({".......",  //
                              ".......",  //
                              "...#...",  //
                              ".......",  //
                              "......."});
  const Path below = through({{0.5, 2.5}, {1.5, 1.5}, {5.5, 1.5}, {6.5, 2.5}});
  const Path above = through({{0.5, 2.5}, {1.5, 3.5}, {5.5, 3.5}, {6.5, 2.5}});
  EXPECT_TRUE(keepsPath(below, above, *costs, 0.0)) << "equal costs";
  const Path longer = through({{0.5, 2.5}, {0.5, 0.5}, {6.5, 0.5}, {6.5, 2.5}});
  EXPECT_FALSE(keepsPath(longer, above, *costs, 0.1));
  EXPECT_TRUE(keepsPath(longer, above, *costs, 0.5));
}

TEST(KeepsPath, NotWhereTheMapBlocksIt) {
  const auto costs = costsOf({".....", ".###.", "....."});
  const Path old = through({{0.5, 1.5}, {4.5, 1.5}});
  const Path fresh = through({{0.5, 1.5}, {0.5, 0.5}, {4.5, 0.5}, {4.5, 1.5}});
  EXPECT_FALSE(keepsPath(old, fresh, *costs, 100.0));
}

TEST(KeepsPath, NotWhereItLeadsElsewhere) {
  const auto costs = costsOf({"....."});
  const Path short_of_it = through({{0.5, 0.5}, {3.5, 0.5}});
  const Path fresh = through({{0.5, 0.5}, {4.5, 0.5}});
  EXPECT_FALSE(keepsPath(short_of_it, fresh, *costs, 100.0));
  Path turned = fresh;
  turned.poses.back().yaw = 1.0;
  EXPECT_FALSE(keepsPath(turned, fresh, *costs, 100.0));
  EXPECT_FALSE(keepsPath(Path{}, fresh, *costs, 100.0));
}

}  // namespace
}  // namespace grid_path_planner::planning
