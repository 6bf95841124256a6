#include "support/path_checker.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/path_through.h"

namespace grid_path_planner::path {

using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

using test::AsciiMap;
using test::kNoViolations;
using test::PathRules;
using test::pathThrough;
using test::pathViolations;

// The violations of a path through points in cell units, whose ends are the ones asked for.
std::vector<std::string> violations(const std::vector<std::string>& lines,
                                    const std::vector<Eigen::Vector2d>& points,
                                    const PathRules& rules = {}) {
  const Path path = pathThrough(points);
  return pathViolations(path, path.poses.front(), path.poses.back(), AsciiMap(lines).map, rules);
}

testing::AssertionResult says(const std::vector<std::string>& violations, const std::string& part) {
  for (const std::string& violation : violations)
    if (test::contains(violation, part)) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "'" << part << "' is not in " << testing::PrintToString(violations);
}

TEST(PathChecker, GoodPaths) {
  const std::vector<std::string> lines = {"....",  //
                                          ".##.",  //
                                          "...."};
  EXPECT_EQ(violations(lines, {{0.5, 0.5}, {3.5, 0.5}, {3.5, 2.5}, {0.5, 2.5}}), kNoViolations);
  EXPECT_EQ(violations(lines, {{0.5, 0.5}}), kNoViolations);
  EXPECT_EQ(violations(lines, {{0.1, 0.1}, {0.2, 0.1}}), kNoViolations);
}

TEST(PathChecker, GrazingIsLegal) {
  const std::vector<std::string> lines = {"....",  //
                                          ".##.",  //
                                          "...."};
  EXPECT_EQ(violations(lines, {{0.5, 0.5}, {1.0, 1.0}, {1.0, 2.0}}), kNoViolations);  // an edge
  EXPECT_EQ(violations(lines, {{0.0, 2.0}, {2.0, 0.0}}), kNoViolations);              // a corner
  EXPECT_EQ(violations(lines, {{1.0, 1.0}, {3.0, 1.0}}), kNoViolations);
  EXPECT_EQ(violations(lines, {{0.5, 0.0}, {3.5, 0.0}}), kNoViolations);  // the map's border
}

// navigation2#5863: any-angle paths cross lethal cells.
TEST(PathChecker, CrossingABlockedCellIsTold) {
  const std::vector<std::string> lines = {"....",  //
                                          ".##.",  //
                                          "...."};
  EXPECT_TRUE(says(violations(lines, {{0.5, 1.5}, {3.5, 1.5}}),
                   "the segment to pose 1 meets the blocked cell (1, 1)"));
  EXPECT_TRUE(says(violations(lines, {{2.5, 1.5}}), "meets the blocked cell (2, 1)"));
  // Cuts a corner by a hundredth of a cell, far from any sample.
  EXPECT_TRUE(says(violations(lines, {{0.0, 2.01}, {2.0, 0.01}}), "meets the blocked cell (1, 1)"));
}

TEST(PathChecker, RunningBetweenBlockedCellsIsTold) {
  EXPECT_TRUE(says(violations({"....",  //
                               ".##.",  //
                               "...."},
                              {{2.0, 0.5}, {2.0, 2.5}}),
                   "runs between blocked cells, right of (1, 1)"));
  EXPECT_TRUE(says(violations({"...",  //
                               ".#.",  //
                               ".#."},
                              {{0.5, 2.0}, {2.5, 2.0}}),
                   "runs between blocked cells, above (1, 1)"));
  // The border of the map is as good as a wall.
  EXPECT_TRUE(says(violations({"#."}, {{0.0, 0.5}, {0.0, 0.8}}), "runs between"));
}

TEST(PathChecker, SqueezingBetweenADiagonalPairIsTold) {
  const std::vector<std::string> lines = {"#.",  //
                                          ".#"};
  EXPECT_TRUE(says(violations(lines, {{1.5, 0.5}, {0.5, 1.5}}), "squeezes"));
  EXPECT_TRUE(says(violations({".#", "#."}, {{0.5, 0.5}, {1.5, 1.5}}), "squeezes"));
  PathRules rules;
  rules.cut_corners = true;
  EXPECT_EQ(violations(lines, {{1.5, 0.5}, {0.5, 1.5}}, rules), kNoViolations);
}

TEST(PathChecker, EndingInAnInnerCornerIsLegal) {
  EXPECT_EQ(violations({"..", "##", "#."}, {{0.5, 0.5}, {1.0, 1.0}}), kNoViolations);
  EXPECT_EQ(violations({".#", "##"}, {{0.5, 0.5}, {1.0, 1.0}}), kNoViolations);
}

TEST(PathChecker, AnEndMayLieWhereNothingCouldPass) {
  const std::vector<std::string> lines = {"#.", ".#"};
  EXPECT_EQ(violations(lines, {{1.0, 1.0}, {0.5, 1.5}}), kNoViolations);
  EXPECT_TRUE(says(violations(lines, {{1.5, 0.5}, {1.0, 1.0}, {0.5, 1.5}}), "squeezes"));
}

TEST(PathChecker, PassingALatticePointInTheOpenIsLegal) {
  EXPECT_EQ(violations({"...", "...", "..."}, {{0.5, 0.5}, {2.5, 2.5}}), kNoViolations);
  EXPECT_EQ(violations({"..#", "..."}, {{0.5, 0.5}, {2.0, 1.0}, {2.5, 1.5}}), kNoViolations);
}

TEST(PathChecker, LeavingTheMapIsTold) {
  EXPECT_TRUE(says(violations({"...", "..."}, {{0.5, 0.5}, {3.5, 0.5}}), "blocked cell (3, 0)"));
  EXPECT_TRUE(says(violations({"...", "..."}, {{0.5, -0.1}, {1.5, 0.5}}), "blocked cell (0, -1)"));
}

// navigation#223: "don't cross unknown" ignored.
TEST(PathChecker, UnknownIsAMatterOfTheRules) {
  EXPECT_EQ(violations({".?."}, {{0.5, 0.5}, {2.5, 0.5}}), kNoViolations);
  PathRules rules;
  rules.unknown_is_passable = false;
  EXPECT_TRUE(says(violations({".?."}, {{0.5, 0.5}, {2.5, 0.5}}, rules), "blocked cell (1, 0)"));
}

TEST(PathChecker, OccupiedIsAMatterOfTheRules) {
  PathRules rules;
  rules.occupied_is_passable = true;
  EXPECT_EQ(violations({".#."}, {{0.5, 0.5}, {2.5, 0.5}}, rules), kNoViolations);
}

TEST(PathChecker, ThresholdsAreFollowed) {
  const OccupancyGrid map(GridGeometry(2, 1, 1.0), {0, 50});
  const Path path = pathThrough({{0.5, 0.5}, {1.5, 0.5}});
  PathRules rules;
  EXPECT_EQ(pathViolations(path, path.poses[0], path.poses[1], map, rules), kNoViolations);
  rules.thresholds.occupied_min = 50;
  EXPECT_TRUE(says(pathViolations(path, path.poses[0], path.poses[1], map, rules), "(1, 0)"));
}

// PX4-Avoidance PR#384: gaps too narrow for the vehicle.
TEST(PathChecker, RadiusBlocksCellsByTheirCentres) {
  const std::vector<std::string> lines = {".....",  //
                                          ".....",  //
                                          "#...."};
  PathRules rules;
  const auto passes = [&](double radius, const Eigen::Vector2d& at) {
    rules.radius = radius;
    return violations(lines, {at}, rules).empty();
  };
  EXPECT_TRUE(passes(0.5, {0.5, 1.5}));  // the centre's distance to the edge is half a cell
  EXPECT_FALSE(passes(0.51, {0.5, 1.5}));
  EXPECT_FALSE(passes(0.51, {0.9, 1.01}));  // the whole cell is
  EXPECT_TRUE(passes(0.7, {1.5, 1.5}));     // diagonally, half a cell times root two
  EXPECT_FALSE(passes(0.71, {1.5, 1.5}));
  EXPECT_TRUE(passes(1.5, {2.5, 2.5}));
  EXPECT_FALSE(passes(1.51, {2.5, 2.5}));
}

TEST(PathChecker, EndsAreTheOnesAskedFor) {
  const AsciiMap map({"....."});
  const Path path = pathThrough({{0.5, 0.5}, {3.5, 0.5}});
  Pose start = path.poses.front(), goal = path.poses.back();
  start.yaw = 1.0;  // of no concern
  EXPECT_EQ(pathViolations(path, start, goal, map.map), kNoViolations);
  goal.position.x() += 1e-6;
  EXPECT_TRUE(says(pathViolations(path, start, goal, map.map), "is not the goal"));
  start.position.y() -= 0.1;
  EXPECT_TRUE(says(pathViolations(path, start, goal, map.map), "is not the start"));
  goal.yaw = 0.1;
  EXPECT_TRUE(says(pathViolations(path, start, goal, map.map), "the last yaw"));
  EXPECT_TRUE(says(pathViolations(Path(), start, goal, map.map), "no poses"));
}

// navigation2 PR#6270: near-duplicates before the last pose.
TEST(PathChecker, CoincidingPosesAreTold) {
  EXPECT_TRUE(says(violations({"..."}, {{0.5, 0.5}, {1.5, 0.5}, {1.5 + 1e-12, 0.5}}), "coincide"));
}

TEST(PathChecker, ATurnOnTheSpotIsTwoPoses) {
  const AsciiMap map({"."});
  Path path = pathThrough({{0.5, 0.5}, {0.5, 0.5}});
  const Pose start = path.poses[0];
  EXPECT_TRUE(says(pathViolations(path, start, start, map.map), "coincide"));
  path.poses[1].yaw = 1.0;
  EXPECT_EQ(pathViolations(path, start, path.poses[1], map.map), kNoViolations);
}

TEST(PathChecker, NumbersThatAreNotFiniteAreTold) {
  const AsciiMap map({"....."});
  Path path = pathThrough({{0.5, 0.5}, {1.5, 0.5}, {3.5, 0.5}});
  const Pose start = path.poses.front(), goal = path.poses.back();
  path.poses[1].yaw = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(says(pathViolations(path, start, goal, map.map), "pose 1 is not finite"));
  path.poses[1] = Pose();
  path.poses[1].position.x() = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(says(pathViolations(path, start, goal, map.map), "pose 1 is not finite"));
}

TEST(PathChecker, FollowsTheMapsPose) {
  const AsciiMap map({".#."}, 0.5, {10.0, 20.0, M_PI / 2});  // the row runs north from (10, 20)
  const Path path = pathThrough({{9.75, 20.25}, {9.75, 21.25}});
  EXPECT_TRUE(
      says(pathViolations(path, path.poses[0], path.poses[1], map.map), "blocked cell (1, 0)"));
}

// Sampling finds no blocked cell that the checker has missed.
TEST(PathCheckerLaw, AgreesWithSamplesWhereTheyAreClear) {
  std::mt19937 random(5863);
  int legal = 0;
  for (int trial = 0; trial < 400; ++trial) {
    OccupancyGrid map(GridGeometry(12, 9, 1.0));
    for (std::int8_t& value : map.values()) value = random() % 8 == 0 ? 100 : 0;
    std::uniform_real_distribution<double> x(0.0, 12.0), y(0.0, 9.0);
    const Eigen::Vector2d from(x(random), y(random)), to(x(random), y(random));
    bool sampled_blocked = false, sampled_deep = false;
    for (int i = 0; i <= 5000; ++i) {
      const Eigen::Vector2d p = from + (to - from) * (i / 5000.0);
      const Cell cell = *map.geometry().cellAt(p);
      if (map[cell] == 0) continue;
      const double depth =
          std::min((p - Eigen::Vector2d(cell.column, cell.row)).minCoeff(),
                   (Eigen::Vector2d(cell.column + 1, cell.row + 1) - p).minCoeff());
      sampled_blocked = true;
      sampled_deep |= depth > PathRules().slack;
    }
    const Path path = pathThrough({from, to});
    const bool told = !pathViolations(path, path.poses[0], path.poses[1], map).empty();
    EXPECT_TRUE(told || !sampled_deep) << "trial " << trial;
    EXPECT_TRUE(!told || sampled_blocked) << "trial " << trial << ": told without a reason";
    legal += !told;
  }
  EXPECT_GT(legal, 40);
  EXPECT_LT(legal, 360);
}

}  // namespace
}  // namespace grid_path_planner::path
