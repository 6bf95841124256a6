// Every state and every transition between two.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "following/closed_loop.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::following {

using base::InputError;
using path::Path;

namespace {

using test::ClosedLoop;
using test::pathOf;
using Kind = FollowEvent::Kind;

const FollowState kStates[] = {FollowState::IDLE,    FollowState::DRIVING, FollowState::PAUSED,
                               FollowState::BLOCKED, FollowState::ARRIVED, FollowState::CANCELLED,
                               FollowState::FAILED};

Path somePath() {
  return pathOf({{0, 0}, {4, 0, 0, 1}});
}

// A follower brought into `state`, its vehicle between two waypoints.
std::unique_ptr<ClosedLoop> in(FollowState state) {
  FollowerOptions options;
  options.missed_waypoint = MissedPolicy::STOP;
  auto loop = std::make_unique<ClosedLoop>(options);
  if (state == FollowState::IDLE) return loop;
  loop->follower.start(somePath(), Join::FIRST);
  loop->runUntil([&] { return loop->pose().position.x() > 1.0; });
  if (state == FollowState::PAUSED) loop->follower.pause();
  if (state == FollowState::CANCELLED) loop->follower.cancel("a test");
  if (state == FollowState::BLOCKED) loop->pose_known = false;
  if (state == FollowState::ARRIVED) loop->runUntilState(FollowState::ARRIVED);
  if (state == FollowState::FAILED) {
    FollowerOptions short_timeout = options;
    short_timeout.blocked_timeout = 0.01;
    loop->follower.setOptions(short_timeout);
    loop->pose_known = false;
    loop->run(0.2);
    loop->pose_known = true;
    loop->follower.setOptions(options);
  }
  loop->step();
  EXPECT_EQ(toString(loop->follower.state()), std::string(toString(state)));
  return loop;
}

TEST(States, TheVelocityIsZeroInEveryStateButDriving) {
  for (const FollowState state : kStates) {
    const auto loop = in(state);
    loop->step();
    EXPECT_EQ(loop->command.isZero(), state != FollowState::DRIVING) << toString(state);
  }
}

// In a frame that is turned by half a turn the vehicle was commanded to drive backwards, by the velocity that it had.
TEST(States, APathInAnotherFrameTurnsNoVelocity) {
  FollowerOptions options;
  PathFollower follower(options);
  const auto inputAt = [](double time, const path::Pose& pose) {
    FollowInput input;
    input.time = time;
    input.pose = pose;
    return input;
  };
  follower.start(pathOf({{0, 0}, {40, 0}}), Join::NEAREST);
  base::BodyVelocity before;
  double time = 0.0;
  for (int i = 0; i < 100; ++i)
    before = follower.update(inputAt(time += 0.05, {{10.0, 0.0, 0.0}, 0.0}));
  ASSERT_GT(before.surge, 0.5);
  Path other = pathOf({{-10, 0}, {-40, 0}});  // in the same direction, where x looks back
  other.frame_id = "odom";
  follower.start(other, Join::NEAREST);
  const auto after = follower.update(inputAt(time += 0.05, {{-10.0, 0.0, 0.0}, M_PI}));
  EXPECT_NEAR(after.surge, before.surge, 1.01 * options.max_acceleration * 0.05);
  EXPECT_NEAR(after.sway, before.sway, 1.01 * options.max_acceleration * 0.05);
}

// Whoever holds the vehicle has it stand, with its pose known or not.
TEST(States, WhatIsHeldReturnsToNoPose) {
  const auto loop = in(FollowState::ARRIVED);
  loop->putAt({2.0, 0.0, 0.0});
  FollowInput input;
  input.time = loop->vehicle.time();
  for (const char* const hold : {"stopped", "", "stopped"}) {
    input.pose = loop->pose();
    input.hold = hold;
    input.time += 0.05;
    EXPECT_EQ(loop->follower.update(input).isZero(), input.hold == "stopped");
  }
}

TEST(States, PauseFromEveryState) {
  for (const FollowState state : kStates) {
    const auto loop = in(state);
    const bool has_drive = loop->follower.active(), holds = state == FollowState::ARRIVED;
    EXPECT_TRUE(loop->follower.pause().done) << toString(state);
    const FollowState without_drive = holds ? FollowState::IDLE : state;
    EXPECT_EQ(loop->follower.state(), has_drive ? FollowState::PAUSED : without_drive)
        << toString(state);
    loop->pose_known = true;
    loop->run(2.0);
    EXPECT_TRUE(loop->command.isZero()) << toString(state);
    EXPECT_EQ(loop->speed(), 0.0) << toString(state);
    loop->follower.start(pathOf({{0, 3, 0, 2}}), Join::NEAREST);
    loop->run(5.0);
    EXPECT_EQ(loop->follower.state(), FollowState::PAUSED)
        << toString(state) << ": whoever pauses sees the next path of a planner drive off";
    EXPECT_EQ(loop->speed(), 0.0) << toString(state);
    EXPECT_TRUE(loop->follower.resume().done);
    EXPECT_TRUE(loop->runUntilState(FollowState::ARRIVED)) << toString(state);
  }
}

TEST(States, ResumeFromEveryState) {
  for (const FollowState state : kStates) {
    const auto loop = in(state);
    const bool has_drive = loop->follower.active();
    EXPECT_EQ(loop->follower.resume().done, has_drive) << toString(state);
    loop->pose_known = true;
    if (has_drive) {
      EXPECT_TRUE(loop->runUntilState(FollowState::ARRIVED)) << toString(state);
    } else {
      EXPECT_EQ(loop->follower.state(), state);
    }
  }
}

// follow_waypoints #7: cancel after pause killed it.
TEST(States, CancelFromEveryStateAndThenTheNextPathIsDriven) {
  for (const FollowState state : kStates) {
    const auto loop = in(state);
    const bool has_drive = loop->follower.active();
    EXPECT_TRUE(loop->follower.cancel("a test").done) << toString(state);
    EXPECT_FALSE(loop->follower.active()) << toString(state);
    if (has_drive) {
      EXPECT_EQ(loop->follower.status(), DriveStatus::CANCELLED);
      EXPECT_EQ(loop->follower.message(), "a test");
    }
    loop->pose_known = true;
    loop->run(2.0);
    EXPECT_EQ(loop->speed(), 0.0) << toString(state);
    loop->follower.start(pathOf({{0, 3, 0, 2}}), Join::NEAREST);
    EXPECT_TRUE(loop->runUntilState(FollowState::ARRIVED)) << toString(state);
    EXPECT_NEAR(loop->pose().position.y(), 3.0, 0.06);
  }
}

TEST(States, ANewPathFromEveryStateButAPauseOutlivesIt) {
  for (const FollowState state : kStates) {
    const auto loop = in(state);
    loop->follower.start(pathOf({{0, 3, 0, 2}}), Join::NEAREST);
    loop->pose_known = true;
    if (state == FollowState::PAUSED) {
      loop->run(5.0);
      EXPECT_EQ(loop->follower.state(), FollowState::PAUSED);
      EXPECT_EQ(loop->speed(), 0.0);
      EXPECT_TRUE(loop->follower.resume().done);
    }
    EXPECT_TRUE(loop->runUntilState(FollowState::ARRIVED)) << toString(state);
    EXPECT_NEAR(loop->pose().position.y(), 3.0, 0.06) << toString(state);
  }
}

TEST(States, ALostPoseStopsAndAPoseThatIsBackGoesOn) {
  const auto loop = in(FollowState::DRIVING);
  loop->pose_known = false;
  loop->step();
  EXPECT_EQ(loop->follower.state(), FollowState::BLOCKED);
  EXPECT_TRUE(loop->command.isZero());
  loop->run(5.0);
  EXPECT_EQ(loop->speed(), 0.0);
  loop->pose_known = true;
  loop->step();
  EXPECT_EQ(loop->follower.state(), FollowState::DRIVING);
  EXPECT_TRUE(loop->runUntilState(FollowState::ARRIVED));
  EXPECT_EQ(loop->waypointsOf(Kind::BLOCKED).size(), 1u);
  EXPECT_EQ(loop->waypointsOf(Kind::UNBLOCKED).size(), 1u);
}

TEST(States, AnOccupiedPathStopsAndAFreeOneGoesOn) {
  const auto loop = in(FollowState::DRIVING);
  std::string why = "a crate at 2, 0";
  loop->check = [&](const std::vector<Eigen::Vector3d>&) { return why; };
  loop->run(3.0);
  EXPECT_EQ(loop->follower.state(), FollowState::BLOCKED);
  EXPECT_EQ(loop->follower.message(), why);
  EXPECT_EQ(loop->speed(), 0.0);
  why.clear();
  EXPECT_TRUE(loop->runUntilState(FollowState::ARRIVED));
}

TEST(States, AnOccupiedPathIsFoundBeforeTheFirstMotion) {
  ClosedLoop loop;
  loop.check = [](const std::vector<Eigen::Vector3d>&) { return std::string("a crate"); };
  loop.follower.start(somePath(), Join::NEAREST);
  loop.run(1.0);
  EXPECT_EQ(loop.pose().position.norm(), 0.0);
}

TEST(States, BlockedForTooLongFailsWithItsCause) {
  for (const bool lost : {true, false}) {
    FollowerOptions options;
    options.blocked_timeout = 2.0;
    ClosedLoop loop(options);
    loop.follower.start(somePath(), Join::FIRST);
    loop.run(1.0);
    loop.pose_known = !lost;
    loop.check = [](const std::vector<Eigen::Vector3d>&) { return std::string("a crate"); };
    loop.run(1.9);
    EXPECT_EQ(loop.follower.state(), FollowState::BLOCKED);
    loop.run(0.3);
    EXPECT_EQ(loop.follower.state(), FollowState::FAILED);
    EXPECT_EQ(loop.follower.status(), lost ? DriveStatus::TF_STALE : DriveStatus::BLOCKED);
  }
}

TEST(States, APathIsJoinedWhenThePoseIsKnown) {
  ClosedLoop loop;
  loop.pose_known = false;
  loop.follower.start(somePath(), Join::NEAREST);
  loop.run(1.0);
  EXPECT_EQ(loop.follower.state(), FollowState::BLOCKED);
  loop.pose_known = true;
  EXPECT_TRUE(loop.runUntilState(FollowState::ARRIVED));
}

TEST(States, TimeThatGoesBackCancels) {
  const auto loop = in(FollowState::DRIVING);
  EXPECT_TRUE(loop->follower.update({0.5, loop->pose()}).isZero());
  EXPECT_EQ(loop->follower.state(), FollowState::CANCELLED);
  EXPECT_NE(loop->follower.message().find("time went back"), std::string::npos);
}

// navigation2 PR#3165: zero waypoints crash. uuv_simulator: 1e180 was accepted.
TEST(States, PathsThatCannotBeDrivenAreRefusedByNameAndTheDriveGoesOn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto loop = in(FollowState::DRIVING);
  const auto refusal = [&](const Path& path) {
    try {
      loop->follower.start(path, Join::FIRST);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refusal(Path()), "a path to drive needs at least one waypoint, got none");
  EXPECT_EQ(refusal(pathOf({{0, 0}, {0, nan}})),
            "waypoint 2 of 2: y must be a finite number of metres, got nan");
  EXPECT_EQ(refusal(pathOf({{1e180, 0}})),
            "waypoint 1 of 1: x must be below 1e6 m in magnitude, got 1e+180");
  EXPECT_EQ(refusal(pathOf({{0, 0, -1e7}})),
            "waypoint 1 of 1: z must be below 1e6 m in magnitude, got -1e+07");
  EXPECT_EQ(refusal(pathOf({{0, 0, 0, nan}})),
            "waypoint 1 of 1: yaw must be a finite angle, got nan");
  EXPECT_TRUE(loop->runUntilState(FollowState::ARRIVED)) << "the drive before";
}

// A goal of the action that replaced a paused one was driven: the pause was lost with the drive.
TEST(States, ADriveThatReplacesAPausedOneBeginsPaused) {
  const Path path = pathOf({{0, 0}, {5, 0}});
  PathFollower follower;
  follower.start(path, Join::FIRST);
  follower.pause();
  follower.abandon("another goal");
  EXPECT_EQ(follower.state(), FollowState::CANCELLED);
  follower.start(path, Join::FIRST);
  EXPECT_EQ(follower.state(), FollowState::PAUSED);
  follower.abandon("another goal");
  EXPECT_TRUE(follower.resume().done) << "before that comes";
  follower.start(path, Join::FIRST);
  EXPECT_EQ(follower.state(), FollowState::DRIVING);
  follower.pause();
  follower.abandon("another goal");
  follower.cancel("enough");
  follower.start(path, Join::FIRST);
  EXPECT_EQ(follower.state(), FollowState::DRIVING) << "a cancel ends the pause";
  follower.abandon("another goal");
  follower.start(path, Join::FIRST);
  EXPECT_EQ(follower.state(), FollowState::DRIVING) << "none was paused";
}

TEST(States, ALoopInOnePlaceIsRefused) {
  FollowerOptions options;
  options.loop = true;
  PathFollower follower(options);
  EXPECT_THROW(follower.start(pathOf({{1, 1}}), Join::FIRST), InputError);
  EXPECT_THROW(follower.start(pathOf({{1, 1}, {1, 1, 0, 2}}), Join::FIRST), InputError);
}

TEST(States, BadOptionsAreRefused) {
  FollowerOptions options;
  options.max_speed = 0.0;
  EXPECT_THROW(PathFollower{options}, InputError);
  options = {};
  options.position_tolerance = 0.5;
  EXPECT_THROW(PathFollower{options}, InputError);
  options = {};
  options.yaw_gain = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(PathFollower{options}, InputError);
}

}  // namespace
}  // namespace grid_path_planner::following
