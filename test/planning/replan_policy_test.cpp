#include "grid_path_planner/planning/replan_policy.h"

#include <gtest/gtest.h>

#include "support/cost_maps.h"

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

TEST(PathBlocked, OnlyWhatRemainsCounts) {
  const auto costs = costsOf({".....", ".#...", "....."});
  const Path path = through({{0.5, 1.5}, {4.5, 1.5}});
  EXPECT_TRUE(pathBlocked(path, Eigen::Vector2d(0.5, 1.5), *costs));
  EXPECT_TRUE(pathBlocked(path, std::nullopt, *costs));
  EXPECT_FALSE(pathBlocked(path, Eigen::Vector2d(2.5, 1.5), *costs)) << "it lies behind";
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
