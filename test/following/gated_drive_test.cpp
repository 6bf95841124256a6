// Drives whose motions are checked: planned as close as the outline allows, through doors, and none touches anything.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <random>

#include "following/closed_loop.h"
#include "grid_path_planner/planning/path_planner.h"
#include "support/ascii_map.h"
#include "support/random_footprints.h"
#include "support/random_vehicles.h"
#include "vehicle/motion_check.h"

namespace grid_path_planner::test {
namespace {

using base::BodyVelocity;
using following::FollowerOptions;
using following::FollowInput;
using following::FollowState;
using following::Join;
using following::PathFollower;
using grid::OccupancyGrid;
using vehicle::Description;
using vehicle::Drive;
using vehicle::PlanarState;

FollowerOptions followerOptionsOf(const Description& robot) {
  FollowerOptions options;
  options.max_speed = robot.max_speed;
  options.max_yaw_rate = robot.max_yaw_rate;
  options.max_acceleration = robot.max_acceleration;
  options.max_yaw_acceleration = robot.max_yaw_acceleration;
  return options;
}

// A vehicle that moves by its model, with its dead time, and drifts within what it declares.
class GatedDrive {
 public:
  GatedDrive(const Description& described, const OccupancyGrid& map, const PlanarState& start,
             unsigned seed = 1)
      : robot(described),
        follower(followerOptionsOf(described), &described),
        state(start),
        map_(map),
        model_(described),
        commanded_(described),
        random_(seed) {}

  // One control step of 0.05 s.
  BodyVelocity step() {
    time += kPeriod;
    FollowInput input;
    input.time = time;
    input.pose = path::Pose{{state.position.x(), state.position.y(), 0.0}, state.yaw};
    commanded_.advanceTo(time);
    PlanarState now = state;
    now.velocity = commanded_.velocity();
    const vehicle::MotionCheck check(robot, map_.geometry(), vehicle::mapObstacles(map_, {}, false),
                                     {now, commanded_.pending(), kPeriod});
    input.motion = [&](const BodyVelocity& command) {
      const auto contact = check.contactOf(command);
      return contact ? "it would touch a cell" : std::string();
    };
    const BodyVelocity command = follower.update(input);
    commanded_.sent(command);
    waiting_.push_back({time + robot.dead_time, command});
    move();
    return command;
  }

  FollowState run(double seconds) {
    double blocked = 0.0;  // s
    for (const double end = time + seconds; time < end && follower.active() && blocked < 5.0;) {
      step();
      blocked = follower.state() == FollowState::BLOCKED ? blocked + kPeriod : 0.0;
      deepest = std::max(deepest, depthInCells(robot, state, map_));
    }
    return follower.state();
  }

  const Description robot;
  PathFollower follower;
  PlanarState state;
  double time = 0.0;
  double deepest = 0.0;  // m

 private:
  static constexpr double kPeriod = 0.05;

  void move() {
    std::uniform_real_distribution<double> drift(-0.7, 0.7);
    for (int i = 0; i < 5; ++i) {
      const double at = time + 0.01 * i;
      while (!waiting_.empty() && waiting_.front().first <= at + 1e-9) {
        followed_ = waiting_.front().second;
        waiting_.pop_front();
      }
      state = model_.advanced(state, followed_, 0.01);
      if (std::hypot(state.velocity.surge, state.velocity.sway) > 0.01)
        state.position += 0.01 * robot.drift * Eigen::Vector2d(drift(random_), drift(random_));
    }
  }

  const OccupancyGrid& map_;
  const vehicle::MotionModel model_;
  vehicle::CommandedVelocity commanded_;
  std::deque<std::pair<double, BodyVelocity>> waiting_;
  BodyVelocity followed_;
  std::mt19937 random_;
};

// m, the root of an area: what a sweep lets through whose footprint is a ten-millionth smaller.
constexpr double kSliver = 5e-4;

Description roundVehicle(Drive drive, double radius) {
  Description robot;
  robot.drive = drive;
  robot.radius = radius;
  robot.max_speed = 0.8;
  if (drive == Drive::OMNIDIRECTIONAL) robot.max_backward_speed = robot.max_sideways_speed = 0.8;
  robot.max_yaw_rate = 1.0;
  robot.max_acceleration = 0.5;
  robot.max_yaw_acceleration = 2.0;
  return robot;
}

// 10 cells a metre; a wall with a door of 1 m, and corners to pass closely.
OccupancyGrid corners() {
  OccupancyGrid map(grid::GridGeometry(80, 80, 0.1, {0, 0, 0}));
  for (int row = 0; row < 50; ++row) map[{40, row}] = 100;
  for (int column = 40; column < 60; ++column) map[{column, 50}] = 100;
  return map;
}

// `radius` set to the vehicle's, as the page said: corners were cut by up to 0.10 m.
TEST(GatedDrive, cutsNoCorner) {
  const OccupancyGrid map = corners();
  for (const Drive drive : {Drive::OMNIDIRECTIONAL, Drive::DIFFERENTIAL}) {
    SCOPED_TRACE(static_cast<int>(drive));
    const Description robot = roundVehicle(drive, 0.3);
    PlanarState start;
    start.position = {3.0, 1.0};
    start.yaw = M_PI / 2;
    GatedDrive gated(robot, map, start);
    gated.follower.start(
        pathOf({{3, 1}, {3.69, 5.11}, {3.69, 5.41}, {6.31, 5.41}, {6.31, 4.0}, {5, 1}}),
        Join::FIRST);
    EXPECT_EQ(FollowState::ARRIVED, gated.run(60.0)) << gated.follower.message();
    EXPECT_EQ(0.0, gated.deepest);
  }
}

// The outline of 2.0 x 0.6 m that ARRIVED with 0.43 m of it in a wall.
TEST(GatedDrive, aLongVehicleStandsBeforeATurnThatTouches) {
  OccupancyGrid map(grid::GridGeometry(80, 30, 0.1, {0, 0, 0}));
  for (int column = 0; column < 80; ++column) map[{column, 8}] = map[{column, 22}] = 100;
  Description robot = roundVehicle(Drive::DIFFERENTIAL, 0.0);
  robot.outline = "[[1.0, 0.3], [-1.0, 0.3], [-1.0, -0.3], [1.0, -0.3]]";
  PlanarState start;
  start.position = {1.5, 1.55};
  GatedDrive gated(robot, map, start);
  gated.follower.start(pathOf({{1.5, 1.55}, {5.0, 1.55, 0.0, M_PI / 2}}), Join::FIRST);
  gated.run(60.0);
  EXPECT_NE(FollowState::ARRIVED, gated.follower.state());
  EXPECT_NEAR(5.0, gated.state.position.x(), 0.06);
  EXPECT_EQ(0.0, gated.deepest);
}

TEST(GatedDrive, aBoxThatAppearsBesideTheLineIsNotTouched) {
  OccupancyGrid map(grid::GridGeometry(80, 30, 0.1, {0, 0, 0}));
  const Description robot = roundVehicle(Drive::OMNIDIRECTIONAL, 0.3);
  PlanarState start;
  start.position = {1.0, 1.55};
  GatedDrive gated(robot, map, start);
  gated.follower.start(pathOf({{1.0, 1.55}, {7.0, 1.55}}), Join::FIRST);
  gated.run(2.0);
  map[{40, 17}] = 100;  // 0.1 m beside the line
  gated.run(20.0);
  EXPECT_EQ(FollowState::BLOCKED, gated.follower.state());
  EXPECT_EQ("it would touch a cell", gated.follower.message());
  EXPECT_EQ(0.0, gated.deepest);
  map[{40, 17}] = 0;
  EXPECT_EQ(FollowState::ARRIVED, gated.run(20.0));
}

bool turnsFreely(const Description& robot, const PlanarState& state, const OccupancyGrid& map) {
  Description disc;
  disc.radius = vehicle::outlineOf(robot).circumscribedRadius() + 0.05;
  return depthInCells(disc, state, map) <= 0.0;
}

// Random vehicles on random maps, with planned paths and with wild ones, drifting within what they declare.
TEST(GatedDriveLaw, touchesNothing) {
  const unsigned seed = 50;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0), any(-3.0, 3.0);
  int arrived = 0, planned = 0;
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    const OccupancyGrid map = randomRooms(random, any(random));
    Description robot = randomDescription(random);
    robot.drift = i % 2 == 0 ? 0.0 : 0.03;
    robot.dead_time = 0.05 * (random() % 5);  // of whole control steps, as the vehicle here has it
    const auto anywhere = [&] {
      PlanarState state;
      do {
        state.position = map.geometry().worldFromGrid({60 * part(random), 60 * part(random)});
        state.yaw = any(random);
      } while (depthInCells(robot, state, map) > 0.0);
      return state;
    };
    const PlanarState start = anywhere(), goal = anywhere();
    GatedDrive gated(robot, map, start, static_cast<unsigned>(i));
    planning::PlannerOptions options;
    options.costmap.radius = vehicle::outlineOf(robot).circumscribedRadius() + 0.05;
    planning::PathPlanner planner(options);
    planner.setMap(std::make_shared<const OccupancyGrid>(map));
    const auto poseOf = [](const PlanarState& state) {
      return path::Pose{{state.position.x(), state.position.y(), 0.0}, state.yaw};
    };
    auto plan = planner.plan({poseOf(start), poseOf(goal)});
    const bool wild = plan.status != base::Status::FOUND || i % 5 == 0;
    if (wild) plan.path.poses = {poseOf(start), poseOf(anywhere()), poseOf(goal)};
    gated.follower.start(plan.path, Join::FIRST);
    const FollowState end = gated.run(90.0);
    ASSERT_LE(gated.deepest, kSliver) << gated.follower.message();
    if (wild || robot.drive == Drive::CAR || !turnsFreely(robot, start, map) ||
        !turnsFreely(robot, goal, map))
      continue;
    ++planned;
    EXPECT_EQ(FollowState::ARRIVED, end)
        << gated.follower.message() << ", drive " << static_cast<int>(robot.drive);
    arrived += end == FollowState::ARRIVED ? 1 : 0;
  }
  EXPECT_GT(planned, 50);
  EXPECT_EQ(planned, arrived);
}

}  // namespace
}  // namespace grid_path_planner::test
