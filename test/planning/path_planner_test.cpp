// Whole plans: what becomes of the ends, and why there is no path.
#include "grid_path_planner/planning/path_planner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "grid_path_planner/base/errors.h"
#include "support/ascii_map.h"

namespace grid_path_planner::planning {

using base::InputError;
using base::Status;
using base::StopSource;
using costmap::ExactCost;
using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using path::Pose;

namespace {

using test::AsciiMap;

Pose poseAt(const Eigen::Vector2d& position, double z = 0.0, double yaw = 0.0) {
  Pose pose;
  pose.position << position, z;
  pose.yaw = yaw;
  return pose;
}

Plan planBetween(const OccupancyGrid& map, const Pose& start, const Pose& goal,
                 const PlannerOptions& options = {}) {
  PathPlanner planner(options);
  planner.setMap(std::make_shared<const OccupancyGrid>(map));
  return planner.plan({start, goal, false});
}

Plan planOn(const AsciiMap& picture, const PlannerOptions& options = {}) {
  const GridGeometry& geometry = picture.map.geometry();
  return planBetween(picture.map, poseAt(geometry.centre(picture.start)),
                     poseAt(geometry.centre(picture.goal)), options);
}

PlannerOptions overTheGrid() {
  PlannerOptions options;
  options.smooth = false;
  return options;
}

bool says(const Plan& report, const std::string& words) {
  return report.message.find(words) != std::string::npos;
}

TEST(PathPlanner, GoesAroundAnObstacle) {
  const Plan report = planOn(AsciiMap({"S#.",  //
                                       ".#.",  //
                                       "..G"}),
                             overTheGrid());
  EXPECT_EQ(report.status, Status::FOUND) << report.message;
  EXPECT_EQ(report.cost, (ExactCost{4, 0})) << report.message;
  EXPECT_EQ(report.cells, 5U);
  EXPECT_EQ(report.path.poses.size(), 5U);
  EXPECT_DOUBLE_EQ(report.length_m, 4.0);
}

TEST(PathPlanner, SaysWhyThereIsNoPath) {
  const Plan report = planOn(AsciiMap({"S#G",  //
                                       ".#."}));
  EXPECT_EQ(report.status, Status::UNREACHABLE);
  EXPECT_TRUE(report.path.empty());
  EXPECT_TRUE(says(report, "(2.5, 0.5)")) << report.message;
  EXPECT_EQ(PathPlanner().plan({}).status, Status::NO_MAP);
}

// Of cartographer: a wall of 57 % is unknown, and the path through it was found without a word.
TEST(PathPlanner, SaysWhereTheThresholdsDoNotFitTheMap) {
  const OccupancyGrid map(GridGeometry(3, 1, 1.0), {38, 57, 38});
  const Plan through = planBetween(map, poseAt({0.5, 0.5}), poseAt({2.5, 0.5}));
  EXPECT_EQ(through.status, Status::FOUND);
  EXPECT_TRUE(says(through,
                   "no cell of the map is free (at most free_max, 25) or occupied (at "
                   "least occupied_min, 65)"))
      << through.message;
  PlannerOptions options;
  options.costmap.thresholds = {45, 50};
  const Plan none = planBetween(map, poseAt({0.5, 0.5}), poseAt({2.5, 0.5}), options);
  EXPECT_EQ(none.status, Status::UNREACHABLE);
  EXPECT_FALSE(says(none, "occupied_min")) << none.message;
}

// explore_lite asks for frontiers at the border, 0.3 m beyond it with a tolerance of 1 m, and had GOAL_OUTSIDE_MAP.
TEST(PathPlanner, AGoalBesideTheMapEndsAtTheNearestPlaceWithinTheTolerance) {
  const OccupancyGrid map = AsciiMap({"...",  //
                                      "..#"})
                                .map;
  PlannerOptions options;
  options.tolerance = 1.0;
  const Pose free = poseAt({0.5, 0.5});
  const Plan plan = planBetween(map, free, poseAt({3.3, 0.5}, 0.0, 0.7), options);
  ASSERT_TRUE(plan.found()) << plan.message;
  EXPECT_EQ(plan.path.poses.back().position.head<2>(), Eigen::Vector2d(2.5, 0.5));
  EXPECT_EQ(plan.path.poses.back().yaw, 0.7);
  EXPECT_TRUE(says(plan, "goal is outside the map: the path ends 0.8")) << plan.message;
  EXPECT_EQ(planBetween(map, free, poseAt({3.3, 1.5}, 0.0, 0.7), options).status,
            Status::GOAL_OUTSIDE_MAP)
      << "none is free there";
  EXPECT_EQ(planBetween(map, free, poseAt({3.6, 0.5}), options).status, Status::GOAL_OUTSIDE_MAP);
  EXPECT_EQ(planBetween(map, free, poseAt({3.3, 0.5})).status, Status::GOAL_OUTSIDE_MAP);
}

TEST(PathPlanner, NamesTheEndThatIsWrong) {
  const OccupancyGrid map = AsciiMap({"..#",  //
                                      "?.."})
                                .map;
  const Pose free = poseAt({0.5, 0.5});
  EXPECT_EQ(planBetween(map, poseAt({-0.1, 0.5}), free).status, Status::START_OUTSIDE_MAP);
  EXPECT_EQ(planBetween(map, free, poseAt({3.0, 0.5})).status, Status::GOAL_OUTSIDE_MAP);
  EXPECT_EQ(planBetween(map, poseAt({2.5, 0.5}), free).status, Status::START_OCCUPIED);
  EXPECT_EQ(planBetween(map, free, poseAt({2.5, 0.5})).status, Status::GOAL_OCCUPIED);
  const double nan = std::nan("");
  EXPECT_EQ(planBetween(map, poseAt({nan, 0.5}), free).status, Status::INVALID_REQUEST);
  EXPECT_EQ(planBetween(map, free, poseAt({0.5, 0.5}, nan)).status, Status::INVALID_REQUEST);
  EXPECT_EQ(planBetween(map, free, poseAt({0.5, 0.5}, 0.0, nan)).status, Status::INVALID_REQUEST);

  PlannerOptions options;
  options.costmap.unknown_is_passable = false;
  const Plan unknown = planBetween(map, free, poseAt({0.5, 1.5}), options);
  EXPECT_EQ(unknown.status, Status::GOAL_OCCUPIED);
  EXPECT_TRUE(says(unknown, "unknown_is_passable")) << unknown.message;
  options.costmap.radius = 0.6;
  const Plan near = planBetween(map, poseAt({1.5, 0.5}), free, options);
  EXPECT_EQ(near.status, Status::START_OCCUPIED);
  EXPECT_TRUE(says(near, "radius")) << near.message;
}

// A plan from where the drive had come nearer than the radius was refused, and nothing said what would help.
TEST(PathPlanner, SaysHowFarAStartMustEscape) {
  const OccupancyGrid map = AsciiMap({"#....", "#....", "#...."}).map;
  const Pose goal = poseAt({4.5, 1.5});
  PlannerOptions options;
  options.costmap.radius = 2.2;
  const Plan refused = planBetween(map, poseAt({1.4, 1.5}), goal, options);
  EXPECT_EQ(refused.status, Status::START_OCCUPIED);
  EXPECT_TRUE(says(refused, "the nearest passable cell is 2.1 m away")) << refused.message;
  options.start_escape_radius = 2.1;
  EXPECT_EQ(planBetween(map, poseAt({1.4, 1.5}), goal, options).status, Status::FOUND);
  EXPECT_FALSE(says(planBetween(map, poseAt({0.5, 1.5}), goal), "start_escape_radius"))
      << "a vehicle in a wall is in the wrong place";
}

// navigation2#2494, #4792, #2517, #5673: start = goal fails.
TEST(PathPlanner, StartAtTheGoalIsAPath) {
  const OccupancyGrid map = AsciiMap({".."}).map;
  const Pose pose = poseAt({0.3, 0.6}, -2.0, 1.0);
  const Plan same = planBetween(map, pose, pose);
  ASSERT_EQ(same.status, Status::FOUND);
  ASSERT_EQ(same.path.poses.size(), 1U);
  EXPECT_EQ(same.path.poses[0].position, pose.position);
  EXPECT_EQ(same.path.poses[0].yaw, 1.0);

  Pose turned_round = pose;
  turned_round.yaw += 2.0 * M_PI;
  EXPECT_EQ(planBetween(map, pose, turned_round).path.poses.size(), 1U);

  const Plan same_cell = planBetween(map, pose, poseAt({0.8, 0.2}, -2.0, 0.5));
  ASSERT_EQ(same_cell.path.poses.size(), 2U);
  EXPECT_EQ(same_cell.cost, ExactCost());
  EXPECT_EQ(same_cell.path.poses[1].yaw, 0.5);
}

// navigation#207, navigation2 PR#6270: the last pose is not the goal, or is there twice.
TEST(PathPlanner, EndsAreThePosesAskedFor) {
  const Plan report = planBetween(AsciiMap({"....."}).map, poseAt({0.9, 0.1}, 3.0),
                                  poseAt({4.2, 0.7}, 5.0, 2.0), overTheGrid());
  ASSERT_EQ(report.path.poses.size(), 5U);
  EXPECT_EQ(report.path.poses.front().position, Eigen::Vector3d(0.9, 0.1, 3.0));
  EXPECT_EQ(report.path.poses.back().position, Eigen::Vector3d(4.2, 0.7, 5.0));
  EXPECT_EQ(report.path.poses.back().yaw, 2.0);
  EXPECT_EQ(report.cost, (ExactCost{4, 0}));
  const double half = report.path.poses[2].position.z();
  EXPECT_GT(half, 3.5);
  EXPECT_LT(half, 4.5);
}

// A cell's centre stays beside an end only where the straight line past it is not legal.
TEST(PathPlanner, CentreOfTheFirstCellStaysOnlyWhereItIsNeeded) {
  const OccupancyGrid map = AsciiMap({".#",  //
                                      ".."})
                                .map;
  // Seen from the lower edge of cell (0, 0) the centre of (0, 1) is straight ahead.
  const Plan open = planBetween(map, poseAt({0.9, 0.1}), poseAt({1.5, 1.5}));
  ASSERT_EQ(open.path.poses.size(), 3U);
  // Cell (1, 1) from (0, 0) through (0, 1): the goal at its far edge is visible from there.
  const OccupancyGrid corner = AsciiMap({"..#",  //
                                         "#..",  //
                                         "..."})
                                   .map;
  const Plan turned = planBetween(corner, poseAt({0.1, 0.95}), poseAt({1.5, 2.5}), overTheGrid());
  ASSERT_EQ(turned.status, Status::FOUND);
  EXPECT_EQ(turned.path.poses[1].position.head<2>(), Eigen::Vector2d(1.5, 0.5));
}

// navigation PR#703: tolerance unused. navigation2#4432: wanted an abort, the robot drove nearby.
TEST(PathPlanner, ToleranceEndsAtTheNearestReachableCell) {
  const AsciiMap picture({"S..#G#",  //
                          "...###"});
  PlannerOptions options;
  EXPECT_EQ(planOn(picture, options).status, Status::UNREACHABLE);
  options.tolerance = 1.9;
  EXPECT_EQ(planOn(picture, options).status, Status::UNREACHABLE);
  options.tolerance = 2.0;
  const Plan report = planOn(picture, options);
  ASSERT_EQ(report.status, Status::FOUND) << report.message;
  EXPECT_EQ(report.path.poses.back().position, Eigen::Vector3d(2.5, 0.5, 0.0));
  EXPECT_TRUE(says(report, "ends 2 m from it")) << report.message;

  const AsciiMap occupied({"S..#"});
  const Pose goal = poseAt({3.9, 0.5}, 0.0, 1.5);
  options.tolerance = 0.0;
  EXPECT_EQ(planBetween(occupied.map, poseAt({0.5, 0.5}), goal, options).status,
            Status::GOAL_OCCUPIED);
  options.tolerance = 1.5;
  const Plan near = planBetween(occupied.map, poseAt({0.5, 0.5}), goal, options);
  ASSERT_EQ(near.status, Status::FOUND) << near.message;
  EXPECT_EQ(near.path.poses.back().position, Eigen::Vector3d(2.5, 0.5, 0.0));
  EXPECT_EQ(near.path.poses.back().yaw, 1.5);
}

// navigation2#6120: "start occupied" on every call.
TEST(PathPlanner, LeavesAnOccupiedStartWithinTheEscapeRadius) {
  const OccupancyGrid map = AsciiMap({"#...",  //
                                      "#..."})
                                .map;
  PlannerOptions options;
  EXPECT_EQ(planBetween(map, poseAt({0.5, 0.5}), poseAt({3.5, 1.5}), options).status,
            Status::START_OCCUPIED);
  options.start_escape_radius = 1.0;
  const Plan report = planBetween(map, poseAt({0.5, 0.5}), poseAt({3.5, 1.5}), options);
  ASSERT_EQ(report.status, Status::FOUND) << report.message;
  EXPECT_EQ(report.path.poses[0].position, Eigen::Vector3d(0.5, 0.5, 0.0));
  EXPECT_EQ(report.path.poses[1].position, Eigen::Vector3d(1.5, 0.5, 0.0));
  EXPECT_TRUE(says(report, "leaves it")) << report.message;
}

TEST(PathPlanner, EscapesToTheSideFromWhichTheGoalIsReached) {
  const OccupancyGrid map = AsciiMap({"...#...",  //
                                      "...#...",  //
                                      "...#..."})
                                .map;
  PlannerOptions options;
  options.start_escape_radius = 2.0;
  for (const double goal : {0.5, 6.5}) {
    const Plan report = planBetween(map, poseAt({3.5, 1.5}), poseAt({goal, 1.5}), options);
    EXPECT_EQ(report.status, Status::FOUND) << report.message;
  }
}

// A tolerance of exactly the distance must not fall to rounding.
TEST(PathPlanner, ToleranceIsInclusive) {
  for (const double resolution : {0.03, 0.05, 0.07, 0.1, 0.3})
    for (const double corner : {0.0, -1.3, 10.7, -33.33}) {
      const AsciiMap picture({".....", ".....", "..#..", ".....", "....."}, resolution,
                             {corner, -corner, 0.0});
      PlannerOptions options;
      options.tolerance = resolution;
      const GridGeometry& geometry = picture.map.geometry();
      const Plan report = planBetween(picture.map, poseAt(geometry.centre({0, 0})),
                                      poseAt(geometry.centre({2, 2})), options);
      ASSERT_EQ(report.status, Status::FOUND) << report.message;
      EXPECT_EQ(report.path.poses.back().position.head<2>(), geometry.centre({2, 1}));
    }
}

// Blocks that the kernel closes are left at full resolution, also towards a substitute of the goal.
TEST(PathPlanner, ToleranceWorksInBlockedBlocksWithoutRetry) {
  for (const bool start_blocked : {false, true}) {
    OccupancyGrid map(GridGeometry(9, 9, 1.0));
    map[Cell{4, 4}] = 100;
    if (start_blocked) map[Cell{0, 0}] = 100;
    PlannerOptions options;
    options.costmap.kernel = 3;
    options.retry_finer = false;
    options.tolerance = 1.0;
    const Plan report = planBetween(map, poseAt({1.5, 1.5}), poseAt({4.5, 4.5}), options);
    ASSERT_EQ(report.status, Status::FOUND) << report.message;
    EXPECT_EQ(report.path.poses.back().position.head<2>(), Eigen::Vector2d(4.5, 3.5));
  }
}

// The open block nearest to a start may be a pocket from which nothing leads on.
TEST(PathPlanner, LeavesABlockedBlockForOneThatLeadsOn) {
  const AsciiMap picture({"..#.......",  //
                          "..#.......",  //
                          "###.......",  //
                          "..S.......",  //
                          "#.........",  //
                          ".........G"});
  PlannerOptions options;
  options.costmap.kernel = 2;
  options.retry_finer = false;
  EXPECT_EQ(planOn(picture, options).status, Status::FOUND);
}

// navigation2#5884: no plan in a 1.1 m aisle at factor 4.
TEST(PathPlanner, PlansAgainAtOneWhereTheKernelClosesAllPaths) {
  const AsciiMap aisle({"S...#...",  //
                        "....#...",  //
                        "........",  //
                        "....#..G"});
  PlannerOptions options;
  options.costmap.kernel = 2;
  const Plan report = planOn(aisle, options);
  ASSERT_EQ(report.status, Status::FOUND) << report.message;
  EXPECT_EQ(report.kernel, 1);
  EXPECT_TRUE(says(report, "kernel 2 closes all paths")) << report.message;
  options.retry_finer = false;
  EXPECT_EQ(planOn(aisle, options).status, Status::UNREACHABLE);
}

TEST(PathPlanner, SearchesAtFullResolutionOutOfABlockedBlock) {
  const AsciiMap picture({"S#......",  //
                          "........",  //
                          "........",  //
                          "......#.",  //
                          ".......G",  //
                          "........"});
  PlannerOptions options;
  options.costmap.kernel = 2;
  options.retry_finer = false;
  const Plan report = planOn(picture, options);
  ASSERT_EQ(report.status, Status::FOUND) << report.message;
  EXPECT_EQ(report.kernel, 2);
  EXPECT_EQ(report.path.poses.front().position, Eigen::Vector3d(0.5, 0.5, 0.0));
  EXPECT_EQ(report.path.poses.back().position, Eigen::Vector3d(7.5, 4.5, 0.0));
}

// navigation#223, navigation2#3285: "don't cross unknown" ignored.
TEST(PathPlanner, NeverCrossesUnknownWhereItMayNot) {
  const AsciiMap picture({"S..?..G",  //
                          "...?...",  //
                          "...?..."});
  PlannerOptions options;
  EXPECT_EQ(planOn(picture, options).status, Status::FOUND);
  options.costmap.unknown_is_passable = false;
  for (int kernel = 1; kernel <= 4; ++kernel) {
    options.costmap.kernel = kernel;
    EXPECT_EQ(planOn(picture, options).status, Status::UNREACHABLE) << kernel;
  }
}

// navigation2#2520, #2690: crosses costly cells despite a cheaper path around them.
TEST(PathPlanner, OfTwoRoutesTheCheaper) {
  const AsciiMap picture({"S????G",  //
                          "......"});
  EXPECT_EQ(planOn(picture, overTheGrid()).cost, (ExactCost{3, 2}));
}

// navigation#922, #26: paths brush obstacles.
TEST(PathPlanner, KeepsToTheMiddleOfACorridor) {
  std::vector<std::string> lines(11, std::string(40, '.'));
  lines.front() = lines.back() = std::string(40, '#');
  lines[5].front() = 'S';
  lines[5].back() = 'G';
  PlannerOptions options = overTheGrid();
  options.costmap.decay = 0.3;
  const AsciiMap picture(lines);
  const Plan report = planBetween(picture.map, poseAt({0.5, 2.5}), poseAt({39.5, 8.5}), options);
  ASSERT_EQ(report.status, Status::FOUND);
  for (const Pose& pose : report.path.poses)
    if (pose.position.x() > 6.0 && pose.position.x() < 34.0) {
      EXPECT_NEAR(pose.position.y(), 5.5, 1.0);
    }
}

TEST(PathPlanner, BadOptionsAndMapsLoseNothing) {
  PathPlanner planner;
  planner.setMap(std::make_shared<const OccupancyGrid>(AsciiMap({".."}).map));
  PlannerOptions options;
  options.planner = "fastest";
  EXPECT_THROW(planner.setOptions(options), InputError);
  options = PlannerOptions();
  options.tolerance = -1.0;
  EXPECT_THROW(planner.setOptions(options), InputError);
  EXPECT_EQ(planner.options().planner, PlannerOptions().planner);

  OccupancyGrid bad(GridGeometry(2, 1, 1.0));
  bad[Cell{1, 0}] = 101;
  EXPECT_THROW(planner.setMap(std::make_shared<const OccupancyGrid>(bad)), InputError);
  EXPECT_THROW(planner.setMap(std::make_shared<const OccupancyGrid>()), InputError);
  EXPECT_EQ(planner.plan({poseAt({0.5, 0.5}), poseAt({1.5, 0.5}), false}).status, Status::FOUND);
}

TEST(PathPlanner, CancelAndTimeLimitAreAnswers) {
  const auto map = std::make_shared<const OccupancyGrid>(GridGeometry(600, 600, 1.0));
  PlannerOptions options;
  options.timeout = 1e-9;
  PathPlanner planner(options);
  planner.setMap(map);
  const PoseRequest request{poseAt({0.5, 0.5}), poseAt({599.5, 400.5}), false};
  EXPECT_EQ(planner.plan(request).status, Status::TIMEOUT);
  StopSource stop;
  stop.cancel();
  EXPECT_EQ(planner.plan(request, stop).status, Status::CANCELLED);
  options.timeout = 0.0;
  planner.setOptions(options);
  EXPECT_EQ(planner.plan(request).status, Status::FOUND);
}

}  // namespace
}  // namespace grid_path_planner::planning
