// The checker of distances against distances that can be seen.
#include "support/kept_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/ascii_map.h"

namespace grid_path_planner::planning {

namespace {

using Points = std::vector<Eigen::Vector2d>;

TEST(KeptDistance, IsThatToTheNearestSquare) {
  const auto map = test::AsciiMap({".....", "..#..", "....?"}).map;  // row 0 first
  EXPECT_NEAR(test::leastDistance({{0.5, 0.5}, {4.5, 0.5}}, map, {}, 9.0), 0.5, 1e-12);
  EXPECT_NEAR(test::leastDistance({{1.0, 0.0}}, map, {}, 9.0), std::sqrt(2.0), 1e-12);
  EXPECT_EQ(test::leastDistance({{0.0, 0.0}, {0.0, 3.0}}, map, {}, 1.5), 1.5);
  EXPECT_EQ(test::leastDistance({{0.5, 1.5}, {4.5, 1.5}}, map, {}, 9.0), 0.0);
  // Nearer than at both ends.
  EXPECT_NEAR(test::leastDistance({{1.0, 0.0}, {4.0, 0.0}}, map, {}, 9.0), 1.0, 1e-12);
}

TEST(KeptDistance, CountsUnknownCellsAndTheBorderWhereAskedFor) {
  const auto map = test::AsciiMap({".....", "..#..", "....?"}).map;
  const Points line = {{3.5, 0.25}, {3.5, 1.5}};
  EXPECT_NEAR(test::leastDistance(line, map, {}, 9.0), 0.5, 1e-12);
  EXPECT_NEAR(test::leastDistance(line, map, {false, true, false}, 9.0), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(test::leastDistance(line, map, {true, true, true}, 9.0), 0.25, 1e-12);
  EXPECT_EQ(test::leastDistance({{3.5, 0.25}, {3.5, -0.1}}, map, {false, false, true}, 9.0), 0.0);
}

TEST(KeptDistance, FollowsTheOriginOfTheMap) {
  const auto map = test::AsciiMap({"#..", "..."}, 0.5, {10.0, -2.0, M_PI / 2.0}).map;
  // The map's x axis points along y: the occupied cell is [9.5, 10] x [-2, -1.5].
  EXPECT_NEAR(test::leastDistance({{9.75, -0.75}}, map, {}, 9.0), 0.75, 1e-12);
}

}  // namespace
}  // namespace grid_path_planner::planning
