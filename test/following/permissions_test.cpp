// What ends a permission to move: a pose that is held too long, too far off, or that jumps.
#include <gtest/gtest.h>

#include "following/closed_loop.h"

namespace grid_path_planner::test {
namespace {

using following::DriveStatus;
using following::FollowerOptions;
using following::FollowInput;
using following::FollowState;
using following::Join;
using following::PathFollower;

// A follower that arrived at (2, 0), and poses that are given to it, 50 a second.
struct Arrived {
  explicit Arrived(const FollowerOptions& options = {}) : follower(options) {
    follower.start(pathOf({{2, 0}}), Join::FIRST);
    for (int i = 0; i < 100 && follower.state() != FollowState::ARRIVED; ++i) tick(2.0, 0.0);
  }

  base::BodyVelocity tick(double x, double y, double yaw = 0.0, const std::string& hold = {}) {
    FollowInput input;
    input.time = time += 0.02;
    input.pose = path::Pose{{x, y, 0.0}, yaw};
    input.hold = hold;
    return follower.update(input);
  }

  // To there, slowly as a current takes it, and what is commanded then.
  base::BodyVelocity drift(double x) {
    base::BodyVelocity velocity;
    const double from = at;
    for (int i = 1; i <= 100; ++i) velocity = tick(from + (x - from) * i / 100.0, 0.0);
    at = x;
    return velocity;
  }

  PathFollower follower;
  double time = 0.0;
  double at = 2.0;
};

TEST(HeldPose, isReturnedToWithinItsDistance) {
  Arrived vehicle;
  ASSERT_EQ(FollowState::ARRIVED, vehicle.follower.state());
  EXPECT_LT(vehicle.drift(2.3).surge, 0.0);
  EXPECT_FALSE(vehicle.follower.holdingEnded());
}

TEST(HeldPose, isNoneFartherOffAndStaysNone) {
  Arrived vehicle;
  EXPECT_TRUE(vehicle.drift(2.6).isZero());
  EXPECT_TRUE(vehicle.follower.holdingEnded());
  EXPECT_NE(std::string::npos, vehicle.follower.message().find("more than hold_distance"));
  EXPECT_TRUE(vehicle.drift(2.3).isZero()) << "it does not set off again";
  EXPECT_TRUE(vehicle.follower.holdingEnded());
}

TEST(HeldPose, endsAfterItsTime) {
  FollowerOptions options;
  options.hold_time = 5.0;
  Arrived vehicle(options);
  EXPECT_LT(vehicle.drift(2.3).surge, 0.0) << "2 s";
  vehicle.drift(2.0);
  EXPECT_TRUE(vehicle.drift(2.3).isZero()) << "6 s";
  EXPECT_TRUE(vehicle.follower.holdingEnded());
  options.hold_time = 0.0;
  EXPECT_TRUE(Arrived(options).drift(2.3).isZero()) << "not at all";
}

// The localiser's estimate jumped by 6 m, and the vehicle set off at full speed.
TEST(HeldPose, isNotReturnedToAcrossAJump) {
  for (const double jump : {6.0, 0.4, -0.4}) {
    Arrived vehicle;
    EXPECT_TRUE(vehicle.tick(2.0 + jump, 0.0).isZero());
    EXPECT_TRUE(vehicle.tick(2.0 + jump, 0.0).isZero());
    EXPECT_TRUE(vehicle.follower.holdingEnded());
    EXPECT_NE(std::string::npos, vehicle.follower.message().find("jumped by"));
  }
  Arrived turned;
  EXPECT_TRUE(turned.tick(2.0, 0.0, 1.0).isZero());
  EXPECT_TRUE(turned.tick(2.0, 0.0, 1.0).isZero());
  EXPECT_TRUE(turned.follower.holdingEnded());
  Arrived nudged;
  nudged.tick(2.2, 0.0);
  EXPECT_LT(nudged.tick(2.2, 0.0).surge, 0.0) << "a correction below pose_jump";
}

TEST(HeldPose, isNotReturnedToAcrossAJumpWhileTheVehicleIsStopped) {
  Arrived vehicle;
  vehicle.tick(8.0, 0.0, 0.0, "stopped");
  EXPECT_TRUE(vehicle.tick(8.0, 0.0).isZero());
  EXPECT_TRUE(vehicle.follower.holdingEnded());
}

TEST(PoseJump, endsADriveUntilANewPathComes) {
  ClosedLoop loop;
  loop.follower.setOptions({});  // with pose_jump
  loop.follower.start(pathOf({{0, 0}, {8, 0}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.x() > 2.0; }, 20.0));
  loop.putAt({2.0, 3.0, 0.0});
  loop.step();
  EXPECT_EQ(DriveStatus::POSE_JUMP, loop.follower.status());
  EXPECT_TRUE(loop.command.isZero());
  loop.run(2.0);
  EXPECT_TRUE(loop.command.isZero());
  loop.follower.start(pathOf({{2, 3}, {8, 0}}), Join::NEAREST);
  EXPECT_TRUE(loop.runUntilState(FollowState::ARRIVED, 60.0)) << loop.follower.message();
}

TEST(PoseJump, isNoneOfAPoseThatWasNotKnownForAWhile) {
  ClosedLoop loop;
  loop.follower.setOptions({});
  loop.follower.start(pathOf({{0, 0}, {8, 0}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.x() > 2.0; }, 20.0));
  loop.pose_known = false;
  loop.run(1.0);
  loop.putAt({3.0, 0.0, 0.0});
  loop.pose_known = true;
  EXPECT_TRUE(loop.runUntilState(FollowState::ARRIVED, 60.0)) << loop.follower.message();
}

// 0.995 m/s was commanded with a max_speed of 0.8, pushed on a slope.
TEST(SpeedLaw, holdsInEveryDirectionPushedOnSlopes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  double fastest = 0.0;
  for (int i = 0; i < 100; ++i) {
    FollowerOptions options;
    options.max_vertical_speed = 0.7;
    ClosedLoop loop(options);
    loop.follower.start(pathOf({{0, 0, 0}, {4, any(random), 3 * any(random), any(random)}, {6, 0}}),
                        Join::FIRST);
    for (int k = 0; k < 200; ++k) {
      loop.putAt(loop.pose().position +
                 0.02 * Eigen::Vector3d(any(random), any(random), any(random)));
      loop.step();
      const base::BodyVelocity& v = loop.command;
      fastest = std::max(fastest, std::hypot(std::hypot(v.surge, v.sway), v.heave));
    }
  }
  EXPECT_LE(fastest, 0.8 + 1e-9);
  EXPECT_GT(fastest, 0.79);
}

}  // namespace
}  // namespace grid_path_planner::test
