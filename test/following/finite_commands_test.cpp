// Commands are finite, whatever tf, paths and clocks say.
//
// What was seen before: one tf with x = 1e160 made 20 of 20 commands NaN, since the square of a
// distance of 1e160 m is infinite; a vehicle that multiplies by them goes anywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/odd_numbers.h"
#include "following/closed_loop.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::following {
namespace {

using path::Path;
using path::Pose;
using test::OddNumbers;
using test::pathOf;

TEST(FiniteCommands, APoseThatCannotBeEndsTheDriveWithinOneTick) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double x : {1e160, -1e160, 1e7, inf, std::nan("")}) {
    for (const bool of_yaw : {false, true}) {
      if (of_yaw && std::isfinite(x)) continue;  // any finite angle is one
      PathFollower follower;
      follower.start(pathOf({{0, 0}, {5, 0}}), Join::FIRST);
      follower.update({1.0, Pose{{0, 0, 0}, 0}});
      EXPECT_FALSE(follower.update({1.1, Pose{{0, 0, 0}, 0}}).isZero());
      const Pose broken = of_yaw ? Pose{{0, 0, 0}, x} : Pose{{x, 0, 0}, 0};
      EXPECT_TRUE(follower.update({1.2, broken}).isZero()) << x;
      EXPECT_EQ(follower.state(), FollowState::FAILED) << x;
      EXPECT_EQ(follower.status(), DriveStatus::INVALID_POSE) << x;
      EXPECT_NE(follower.message().find("within 1e6 m"), std::string::npos) << follower.message();
      follower.start(pathOf({{0, 0}, {5, 0}}), Join::FIRST);
      follower.update({1.3, Pose{{0, 0, 0}, 0}});
      EXPECT_FALSE(follower.update({1.4, Pose{{0, 0, 0}, 0}}).isZero()) << "the next drive";
    }
  }
}

TEST(FiniteCommands, APoseThatCannotBeEndsTheHoldingOfOne) {
  test::ClosedLoop loop;
  loop.follower.start(pathOf({{0, 0}, {1, 0}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  const double time = loop.vehicle.time() + 1.0;
  EXPECT_TRUE(loop.follower.update({time, Pose{{1e160, 0, 0}, 0}}).isZero());
  EXPECT_EQ(loop.follower.state(), FollowState::FAILED);
}

TEST(FiniteCommands, ATimeThatIsNoneEndsTheDrive) {
  PathFollower follower;
  follower.start(pathOf({{0, 0}, {5, 0}}), Join::FIRST);
  follower.update({1.0, Pose{{0, 0, 0}, 0}});
  EXPECT_TRUE(follower.update({std::nan(""), Pose{{0, 0, 0}, 0}}).isZero());
  EXPECT_EQ(follower.state(), FollowState::FAILED);
}

Pose anyPose(OddNumbers& numbers) {
  const bool odd = numbers.below(4) == 0;
  const auto number = [&] { return odd ? numbers.any() : numbers.near(); };
  return {{number(), number(), number()}, number()};
}

FollowerOptions anyOptions(OddNumbers& numbers) {
  FollowerOptions options;
  options.mode = numbers.below(2) == 0 ? FollowMode::CONTINUOUS : FollowMode::STOP_AT_EACH;
  options.facing = numbers.below(2) == 0 ? FacingMode::PATH_YAW : FacingMode::ALONG;
  options.missed_waypoint = static_cast<MissedPolicy>(numbers.below(3));
  options.loop = numbers.below(4) == 0;
  options.settle_time = 0.0;
  options.pose_jump = numbers.below(4) == 0 ? 0.3 : 0.0;
  options.hold_distance = 100.0;
  options.pursuit_distance = numbers.below(2) == 0 ? 0.01 : 0.4;
  return options;
}

TEST(FiniteCommandsLaw, AMillionRandomPosesPathsAndTimes) {
  OddNumbers numbers(1);
  int not_finite = 0, moving = 0;
  for (int poses = 0; poses < 1'000'000;) {
    PathFollower follower(anyOptions(numbers));
    for (int tries = 0; tries < 3; ++tries) {
      Path path;
      for (unsigned i = numbers.below(6) + 1; i > 0; --i) path.poses.push_back(anyPose(numbers));
      try {
        follower.start(path, numbers.below(2) == 0 ? Join::FIRST : Join::NEAREST);
      } catch (const base::InputError&) {
      }
    }
    double time = numbers.below(100);
    for (int tick = 0; tick < 20; ++tick, ++poses) {
      time += numbers.below(20) == 0 ? numbers.any() : 0.02;
      const base::BodyVelocity velocity = follower.update({time, anyPose(numbers)});
      not_finite += velocity.isFinite() ? 0 : 1;
      moving += velocity.isZero() ? 0 : 1;
      if (!std::isfinite(time)) time = 0.0;
    }
    follower.takeEvents();
  }
  EXPECT_EQ(not_finite, 0);
  EXPECT_GT(moving, 100'000) << "the law is of commands, not of standing still";
}

}  // namespace
}  // namespace grid_path_planner::following
