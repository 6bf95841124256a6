// Ends that are nearer to obstacles than what is kept: occupied cells, unknown ones and the border are one rule.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/planning/path_planner.h"
#include "support/ascii_map.h"
#include "support/kept_distance.h"

namespace grid_path_planner::planning {

using base::Status;
using costmap::Outside;
using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using path::Pose;

namespace {

Pose poseAt(double x, double y) {
  Pose pose;
  pose.position << x, y, 0.0;
  return pose;
}

Plan planOn(const OccupancyGrid& map, const Pose& start, const Pose& goal,
            const PlannerOptions& options) {
  PathPlanner planner(options);
  planner.setMap(std::make_shared<const OccupancyGrid>(map));
  return planner.plan({start, goal, false});
}

Plan planOn(const std::vector<std::string>& lines, const Pose& start, const Pose& goal,
            const PlannerOptions& options) {
  return planOn(test::AsciiMap(lines).map, start, goal, options);
}

PlannerOptions withRadius(double radius) {
  PlannerOptions options;
  options.costmap.radius = radius;
  return options;
}

using Points = std::vector<Eigen::Vector2d>;

constexpr double kEndRounding = 1e-6;  // m
constexpr int kOpenSide = 60;          // cells
constexpr double kOpenResolution = 0.05;
constexpr test::KeptFrom kFromCells{true, true, false};

Points cornersOf(const path::Path& path) {
  Points points;
  for (const Pose& pose : path.poses) points.push_back(pose.position.head<2>());
  return points;
}

// Free, but for some cells.
OccupancyGrid openExcept(const std::vector<Cell>& cells, int value) {
  OccupancyGrid map(GridGeometry(kOpenSide, kOpenSide, kOpenResolution));
  for (const Cell cell : cells) map[cell] = static_cast<std::int8_t>(value);
  return map;
}

// From occupied cells too, and not from the border.
PlannerOptions keptFromUnknown(double radius) {
  PlannerOptions options = withRadius(radius);
  options.costmap.unknown_is_passable = false;
  options.costmap.outside = Outside::FREE;
  return options;
}

const std::vector<std::string> kWall = {"#......",  //
                                        "#......",  //
                                        "#......"};

// The cell's centre is 0.5 m from the wall: only the pose is too near.
TEST(PathEnds, AGoalNearerThanTheRadiusIsOccupied) {
  const Plan plan = planOn(kWall, poseAt(6.5, 1.5), poseAt(1.3, 1.5), withRadius(0.5));
  EXPECT_EQ(plan.status, Status::GOAL_OCCUPIED);
  EXPECT_EQ(plan.message,
            "goal (1.3, 1.5) is 0.3 m from an occupied cell, nearer than the radius of 0.5 m");
  PlannerOptions tolerant = withRadius(0.5);
  tolerant.tolerance = 1.0;
  const Plan near = planOn(kWall, poseAt(6.5, 1.5), poseAt(1.3, 1.5), tolerant);
  ASSERT_EQ(near.status, Status::FOUND);
  EXPECT_EQ(near.path.poses.back().position.head<2>(), Eigen::Vector2d(1.5, 1.5));
}

TEST(PathEnds, AStartNearerThanTheRadiusIsLeftWithoutComingNearer) {
  const Plan plan = planOn(kWall, poseAt(1.3, 0.2), poseAt(6.5, 1.5), withRadius(0.5));
  ASSERT_EQ(plan.status, Status::FOUND) << plan.message;
  EXPECT_NE(plan.message.find("the start is 0.3 m from an occupied cell, nearer than the radius of "
                              "0.5 m"),
            std::string::npos)
      << plan.message;
}

// A segment to the goal that passes the wall at 0.35 m was taken, since the cells beside the wall
// are passable.
TEST(PathEnds, TheSegmentToAnEndKeepsTheRadius) {
  const std::vector<std::string> corner = {"......",  //
                                           "......",  //
                                           "..##..",  //
                                           "......"};
  const Plan plan = planOn(corner, poseAt(0.5, 1.5), poseAt(4.5, 2.5), withRadius(0.5));
  ASSERT_EQ(plan.status, Status::FOUND);
  EXPECT_GT(plan.path.poses.size(), 2U);
}

// A start near one unknown cell lowered what was kept from all of them, and the path passed another one, two
// metres on, at 0.225 m.
TEST(PathEnds, AStartNearOneUnknownCellComesNoNearerToOthers) {
  const Pose start = poseAt(0.675, 0.825), goal = poseAt(2.825, 1.025);
  const PlannerOptions options = keptFromUnknown(0.25);
  const OccupancyGrid far = openExcept({{40, 20}}, -1), both = openExcept({{10, 20}, {40, 20}}, -1);
  const Plan plan = planOn(both, start, goal, options);
  ASSERT_EQ(plan.status, Status::FOUND) << plan.message;
  EXPECT_NE(plan.message.find("the start is 0.2151 m from an unknown cell, nearer than the "
                              "radius_to_unknown of 0.25 m"),
            std::string::npos)
      << plan.message;
  const Points points = cornersOf(plan.path);
  EXPECT_GE(test::leastDistance(points, far, kFromCells, 1.0), 0.25 - kEndRounding);
  EXPECT_GE(test::leastDistance({points.begin() + 1, points.end()}, both, kFromCells, 1.0),
            0.25 - kEndRounding);
  EXPECT_NEAR(
      test::leastDistance(points, far, kFromCells, 1.0),
      test::leastDistance(cornersOf(planOn(far, start, goal, options).path), far, kFromCells, 1.0),
      1e-9);
}

TEST(PathEnds, UnknownCellsAreKeptFromAsOccupiedOnesAre) {
  const PlannerOptions options = keptFromUnknown(0.25);
  const OccupancyGrid unknown = openExcept({{20, 20}}, -1), occupied = openExcept({{20, 20}}, 100);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> near(0.6, 1.45);
  std::map<Status, int> statuses;
  for (int trial = 0; trial < 300; ++trial) {
    const Pose one = poseAt(near(random), near(random));
    const Pose other = trial % 2 == 0 ? poseAt(2.5, 2.0) : poseAt(near(random), near(random));
    const Plan a = planOn(unknown, one, other, options), b = planOn(occupied, one, other, options);
    ASSERT_EQ(a.status, b.status) << a.message << "; " << b.message;
    EXPECT_EQ(cornersOf(a.path), cornersOf(b.path));
    ++statuses[a.status];
  }
  EXPECT_GT(statuses[Status::FOUND], 100);
  EXPECT_GT(statuses[Status::START_OCCUPIED], 20);
  EXPECT_GT(statuses[Status::GOAL_OCCUPIED], 20);
}

TEST(PathEnds, AGoalNearUnknownCellsIsOccupiedOrReplaced) {
  const OccupancyGrid map = openExcept({{40, 20}}, -1);
  PlannerOptions options = keptFromUnknown(0.25);
  const Pose start = poseAt(0.5, 1.0), goal = poseAt(1.9, 1.025);
  const Plan refused = planOn(map, start, goal, options);
  EXPECT_EQ(refused.status, Status::GOAL_OCCUPIED);
  EXPECT_EQ(refused.message,
            "goal (1.9, 1.025) is nearer than the radius_to_unknown of 0.25 m to an unknown cell");
  options.tolerance = 0.3;
  const Plan replaced = planOn(map, start, goal, options);
  ASSERT_EQ(replaced.status, Status::FOUND) << replaced.message;
  EXPECT_GE(test::leastDistance(cornersOf(replaced.path), map, kFromCells, 1.0),
            0.25 - kEndRounding);
}

// What is kept from unknown cells and the border is that of the goal which is used, as if it were asked for.
TEST(PathEnds, AGoalThatIsReplacedLowersNothing) {
  std::mt19937 random(49);
  std::uniform_real_distribution<double> anywhere(0.05, kOpenSide * kOpenResolution - 0.05);
  int replaced = 0;
  for (int trial = 0; trial < 300; ++trial) {
    PlannerOptions options = keptFromUnknown(0.25);
    options.costmap.outside = trial % 2 == 0 ? Outside::UNKNOWN : Outside::OCCUPIED;
    options.tolerance = 0.6;
    const Pose start = poseAt(1.5, 1.5);
    std::vector<Cell> cells;
    for (int i = 0; i < 8; ++i) {
      const Cell cell{int(random() % kOpenSide), int(random() % kOpenSide)};
      if (std::abs(cell.column - 30) + std::abs(cell.row - 30) > 14) cells.push_back(cell);
    }
    const OccupancyGrid map = openExcept(cells, -1);
    const Plan plan = planOn(map, start, poseAt(anywhere(random), anywhere(random)), options);
    if (!plan.found() || plan.message.find("the path ends") == std::string::npos) continue;
    ++replaced;
    const Points points = cornersOf(plan.path);
    EXPECT_GE(test::leastDistance(points, map, {true, true, true}, 1.0), 0.25 - kEndRounding);
    const Plan asked = planOn(map, start, poseAt(points.back().x(), points.back().y()), options);
    EXPECT_EQ(points, cornersOf(asked.path));
  }
  EXPECT_GT(replaced, 60);
}

TEST(PathEnds, TheBorderIsKeptFromAsCellsAre) {
  PlannerOptions options = withRadius(1.5);
  options.costmap.outside = Outside::OCCUPIED;
  const std::vector<std::string> open(7, ".......");
  const Plan inside = planOn(open, poseAt(1.5, 1.5), poseAt(5.5, 5.5), options);
  ASSERT_EQ(inside.status, Status::FOUND);
  const Plan goal = planOn(open, poseAt(1.5, 1.5), poseAt(6.5, 5.5), options);
  EXPECT_EQ(goal.status, Status::GOAL_OCCUPIED);
  EXPECT_EQ(goal.message, "goal (6.5, 5.5) is nearer than 1.5 m to the border of the map");
  const Plan start = planOn(open, poseAt(0.7, 3.5), poseAt(5.5, 3.5), options);
  ASSERT_EQ(start.status, Status::FOUND) << start.message;
  EXPECT_NE(start.message.find("the start is 0.7 m from the border of the map, nearer than the "
                               "1.5 m that outside keeps"),
            std::string::npos)
      << start.message;
  const Plan deep = planOn(open, poseAt(0.05, 3.5), poseAt(5.5, 3.5), options);
  EXPECT_EQ(deep.status, Status::START_OCCUPIED) << "1.45 m are more than a cell's diagonal";
  EXPECT_NE(deep.message.find("the nearest passable cell is 1.45 m away"), std::string::npos)
      << deep.message;
  options.start_escape_radius = 1.5;
  EXPECT_EQ(planOn(open, poseAt(0.05, 3.5), poseAt(5.5, 3.5), options).status, Status::FOUND);
}

// Occupied and unknown cells at random; half of the others are as far from the start as it may be, or nearer.
OccupancyGrid scattered(std::mt19937& random, const Eigen::Vector2d& start, double radius) {
  std::vector<Cell> cells;
  for (int i = 0; i < 12; ++i)
    cells.push_back({int(random() % kOpenSide), int(random() % kOpenSide)});
  const double angle = 0.001 * double(random() % 6283);
  const double away = radius * (0.6 + 0.001 * double(random() % 500));
  const Eigen::Vector2d near =
      (start + away * Eigen::Vector2d(std::cos(angle), std::sin(angle))) / kOpenResolution;
  const Cell beside{int(std::floor(near.x())), int(std::floor(near.y()))};
  if (GridGeometry(kOpenSide, kOpenSide, kOpenResolution).contains(beside)) cells.push_back(beside);
  OccupancyGrid map = openExcept(cells, -1);
  for (std::size_t i = 0; i < cells.size(); i += 2) map[cells[i]] = random() % 2 == 0 ? 100 : -1;
  return map;
}

TEST(PathEnds, OnlyTheFirstSegmentIsNearerThanWhatIsKept) {
  std::mt19937 random(48);
  std::uniform_real_distribution<double> anywhere(0.05, kOpenSide * kOpenResolution - 0.05);
  const std::string planners[] = {"weighted_jump_point", "anya", "lazy_theta_star"};
  int near = 0;
  for (int trial = 0; trial < 600; ++trial) {
    PlannerOptions options = keptFromUnknown(0.06 + 0.001 * double(random() % 200));
    options.planner = planners[random() % 3];
    options.costmap.unknown_weight = 1;
    options.costmap.outside = choicesOf(Outside{})[random() % 3].second;
    options.smooth = random() % 2 == 0;
    options.tolerance = random() % 2 == 0 ? 0.3 : 0.0;
    const Pose start = poseAt(anywhere(random), anywhere(random));
    const OccupancyGrid map = scattered(random, start.position.head<2>(), options.costmap.radius);
    const Plan plan = planOn(map, start, poseAt(anywhere(random), anywhere(random)), options);
    if (!plan.found()) continue;
    SCOPED_TRACE("trial " + std::to_string(trial) + ' ' + options.planner);
    const test::KeptFrom from{true, true, options.costmap.outside != Outside::FREE};
    const double kept = options.costmap.radius;
    const Points points = cornersOf(plan.path);
    const double at_start = test::leastDistance({points[0]}, map, from, kept);
    near += at_start < kept;
    EXPECT_GE(test::leastDistance(points, map, from, kept), at_start - kEndRounding);
    const auto beyond = points.begin() + (points.size() > 1 ? 1 : 0);
    EXPECT_GE(test::leastDistance({beyond, points.end()}, map, from, kept),
              std::min(kept, points.size() > 1 ? kept : at_start) - kEndRounding);
  }
  EXPECT_GT(near, 60);
}

}  // namespace
}  // namespace grid_path_planner::planning
