// How well a path is driven.
#include <gtest/gtest.h>

#include <random>

#include "following/closed_loop.h"

namespace grid_path_planner::following {

using base::BodyVelocity;
using path::Path;

namespace {

using test::ClosedLoop;
using test::distanceTo;
using test::pathOf;
using Kind = FollowEvent::Kind;

FollowerOptions stopAtEach() {
  FollowerOptions options;
  options.mode = FollowMode::STOP_AT_EACH;
  return options;
}

TEST(Drive, ArrivesAtTheLastPoseAndYaw) {
  ClosedLoop loop;
  const Path path = pathOf({{0, 0}, {5, 0, -1}, {5, 4, -2, 1.5}});
  loop.follower.start(path, Join::FIRST);
  std::vector<int> current{0};
  loop.each_step = [&] {
    if (loop.follower.currentWaypoint() != current.back())
      current.push_back(loop.follower.currentWaypoint());
  };
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_EQ(current, (std::vector<int>{0, 1, 2}));
  loop.run(3.0);
  EXPECT_LT((loop.pose().position - path.poses.back().position).norm(), 0.06);
  EXPECT_NEAR(loop.pose().yaw, 1.5, 0.06);
  EXPECT_EQ(loop.speed(), 0.0);
  EXPECT_EQ(loop.follower.status(), DriveStatus::ARRIVED);
  EXPECT_EQ(loop.waypointsOf(Kind::REACHED), (std::vector<int>{0, 1, 2}));
}

// A drive of an hour said nothing between its first second and its last.
TEST(Drive, TellsItsStartItsMiddleAndItsEndOnceEach) {
  ClosedLoop loop;
  loop.follower.start(pathOf({{0, 0}, {3, 0}, {6, 0}, {6, 4}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  loop.run(3.0);
  ASSERT_EQ(loop.events.front().kind, Kind::STARTED);
  EXPECT_EQ(loop.events.front().message, "drives a path of 4 waypoints, 10 m");
  EXPECT_EQ(loop.waypointsOf(Kind::STARTED).size(), 1u);
  EXPECT_EQ(loop.waypointsOf(Kind::HALFWAY), std::vector<int>{2});
  EXPECT_EQ(loop.waypointsOf(Kind::ENDED), std::vector<int>{3});
  for (const FollowEvent& event : loop.events) {
    if (event.kind != Kind::HALFWAY) continue;
    EXPECT_NE(event.message.find("waypoint 3 of 4 is next"), std::string::npos) << event.message;
  }
}

// follow_waypoints #15, #7: the vehicle stopped at every point.
TEST(Drive, ContinuousPassesIntermediateWaypointsWithoutStopping) {
  ClosedLoop loop;
  const Path path = pathOf({{0, 0}, {3, 0}, {3, 3}, {6, 3}, {9, 0}});
  loop.follower.start(path, Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.x() > 0.5; }));
  double slowest = 1.0, farthest = 0.0;
  loop.each_step = [&] {
    farthest = std::max(farthest, distanceTo(path, loop.pose().position));
    if (loop.follower.distanceRemaining() > 0.5) slowest = std::min(slowest, loop.speed());
  };
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_GT(slowest, 0.15);
  EXPECT_LT(farthest, 0.2) << "corners are not cut by more than the acceptance radius";
  EXPECT_TRUE(loop.follower.missedWaypoints().empty());
}

TEST(Drive, StopAtEachStopsAtEach) {
  ClosedLoop loop(stopAtEach());
  const Path path = pathOf({{0, 0, 0, 0}, {2, 0, 0, 1}, {2, 2, 0, 2}, {0, 2, 0, 3}});
  loop.follower.start(path, Join::FIRST);
  std::vector<double> slowest(4, 1.0), yaw_error(4, 3.0);
  loop.each_step = [&] {
    for (std::size_t i = 0; i < 4; ++i) {
      if ((loop.pose().position - path.poses[i].position).norm() > 0.06) continue;
      slowest[i] = std::min(slowest[i], loop.speed());
      yaw_error[i] = std::min(
          yaw_error[i], std::abs(std::remainder(loop.pose().yaw - path.poses[i].yaw, 6.2831853)));
    }
  };
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(slowest[i], 0.03) << i;
    EXPECT_LT(yaw_error[i], 0.06) << i;
  }
}

TEST(Drive, LooksAsTheWaypointsSay) {
  ClosedLoop loop;
  loop.follower.start(pathOf({{0, 0, 0, 0}, {6, 0, 0, 1.2}, {6.5, 0, 0, 1.2}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.x() > 3.0; }));
  EXPECT_NEAR(loop.pose().yaw, 0.6, 0.2);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_NEAR(loop.pose().yaw, 1.2, 0.06);
}

TEST(Drive, FacesAlongThePathAndAtTheEndAsTheWaypointSays) {
  FollowerOptions options;
  options.facing = FacingMode::ALONG;
  ClosedLoop loop(options);
  loop.follower.start(pathOf({{0, 0, 0, 2}, {0, 6, 0, -1}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.y() > 3.0; }));
  EXPECT_NEAR(loop.pose().yaw, M_PI / 2, 0.05);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_NEAR(loop.pose().yaw, -1.0, 0.06);
}

TEST(Drive, PushedFarOffThePathItComesStraightBackBeforeItGoesOn) {
  ClosedLoop loop;
  const Path path = pathOf({{0, 0}, {10, 0}});
  loop.follower.start(path, Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.x() > 2.0; }));
  loop.vehicle.reset({Eigen::Vector3d(3.0, 2.0, 0.0), 0.0, {}});
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.y() < 0.3; }));
  EXPECT_LT(loop.pose().position.x(), 4.0) << "0.64 m to brake";
  double lowest = 0.0;
  loop.each_step = [&] { lowest = std::min(lowest, loop.pose().position.y()); };
  EXPECT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_GT(lowest, -0.15) << "it does not swing over to the other side";
}

// With a lookahead that reaches round the turn, the point to steer to lies beside or
// behind.
TEST(Drive, ThereAndBackWithAFarPursuitAndASmallAcceptanceRadius) {
  FollowerOptions options;
  options.acceptance_radius = 0.1;
  options.pursuit_distance = 1.5;
  ClosedLoop loop(options);
  loop.follower.start(pathOf({{0, 0}, {4, 0}, {0, 0.2}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_EQ(loop.waypointsOf(Kind::REACHED), (std::vector<int>{0, 1, 2}));
}

TEST(Drive, OneWaypointAndWhereItStandsAlready) {
  ClosedLoop loop({}, {1, 2, 3}, 0.5);
  loop.follower.start(pathOf({{1, 2, 3, 0.5}}), Join::NEAREST);
  EXPECT_TRUE(loop.runUntilState(FollowState::ARRIVED, 2.0));
  loop.follower.start(pathOf({{2, 2, 3, 0.5}}), Join::NEAREST);
  EXPECT_TRUE(loop.runUntilState(FollowState::ARRIVED, 20.0));
  EXPECT_NEAR(loop.pose().position.x(), 2.0, 0.06);
}

TEST(Drive, TurnsOnTheSpotBetweenTwoWaypointsInOnePlace) {
  ClosedLoop loop(stopAtEach());
  loop.follower.start(pathOf({{1, 0, 0, 0}, {1, 0, 0, 1.5}, {1, 0, 0, -1.5}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_EQ(loop.waypointsOf(Kind::REACHED), (std::vector<int>{0, 1, 2}));
  EXPECT_NEAR(loop.pose().yaw, -1.5, 0.06);
}

TEST(Drive, ThereAndBackOnTheSameLineIsDrivenToItsEnd) {
  ClosedLoop loop;
  loop.follower.start(pathOf({{0, 0}, {4, 0}, {0, 0}}), Join::FIRST);
  double farthest = 0.0;
  loop.each_step = [&] { farthest = std::max(farthest, loop.pose().position.x()); };
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_NEAR(farthest, 4.0, 0.3);
  EXPECT_NEAR(loop.pose().position.x(), 0.0, 0.06);
  EXPECT_TRUE(loop.follower.missedWaypoints().empty());
}

// A closed path joined at its nearest point must not end at once.
TEST(Drive, AClosedPathIsDrivenRound) {
  ClosedLoop loop({}, {0.01, 0.02, 0.0});
  loop.follower.start(pathOf({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}}), Join::NEAREST);
  double farthest = 0.0;
  loop.each_step = [&] { farthest = std::max(farthest, loop.pose().position.norm()); };
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_GT(farthest, 4.0);
}

TEST(Drive, AFileStartsAtItsFirstWaypoint) {
  ClosedLoop loop({}, {4.0, 0.5, 0.0});
  loop.follower.start(pathOf({{0, 0}, {3, 0}, {6, 0}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_EQ(loop.waypointsOf(Kind::REACHED), (std::vector<int>{0, 1, 2}));
}

TEST(Drive, APathIsJoinedAtItsNearestPointAheadAndWhatIsNotDrivenIsReported) {
  ClosedLoop loop({}, {4.0, 0.5, 0.0});
  loop.follower.start(pathOf({{0, 0}, {3, 0}, {6, 0}}), Join::NEAREST);
  double least = 4.0;
  loop.each_step = [&] { least = std::min(least, loop.pose().position.x()); };
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_GT(least, 3.95) << "it never drove back";
  EXPECT_EQ(loop.waypointsOf(Kind::JOINED), (std::vector<int>{2}));
  EXPECT_EQ(loop.waypointsOf(Kind::REACHED), (std::vector<int>{2}));
}

TEST(Drive, LoopsWithoutStopping) {
  FollowerOptions options;
  options.loop = true;
  ClosedLoop loop(options);
  loop.follower.start(pathOf({{0, 0}, {3, 0}, {3, 3}, {0, 3}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.x() > 0.5; }));
  double slowest = 1.0;
  loop.each_step = [&] { slowest = std::min(slowest, loop.speed()); };
  ASSERT_TRUE(loop.runUntil([&] { return loop.waypointsOf(Kind::LAP).size() == 3; }));
  EXPECT_GT(slowest, 0.15);
  EXPECT_EQ(loop.follower.state(), FollowState::DRIVING);
  const std::vector<int> reached = loop.waypointsOf(Kind::REACHED);
  for (std::size_t i = 0; i < reached.size(); ++i) EXPECT_EQ(reached[i], static_cast<int>(i % 4));
}

TEST(Drive, AWaypointThatWasPushedPastIsSkippedAndReported) {
  ClosedLoop loop;
  loop.follower.start(pathOf({{0, 0}, {3, 0}, {6, 0}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.x() > 1.0; }));
  loop.vehicle.reset({Eigen::Vector3d(4.5, 2.0, 0.0), 0.0, {}});
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_EQ(loop.follower.missedWaypoints(), (std::vector<int>{1}));
  EXPECT_EQ(loop.waypointsOf(Kind::MISSED), (std::vector<int>{1}));
}

TEST(Drive, AWaypointThatWasPushedPastStopsTheDriveWherePolicySaysSo) {
  FollowerOptions options;
  options.missed_waypoint = MissedPolicy::STOP;
  ClosedLoop loop(options);
  loop.follower.start(pathOf({{0, 0}, {3, 0}, {6, 0}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.x() > 1.0; }));
  loop.vehicle.reset({Eigen::Vector3d(4.5, 2.0, 0.0), 0.0, {}});
  ASSERT_TRUE(loop.runUntilState(FollowState::FAILED));
  EXPECT_EQ(loop.follower.status(), DriveStatus::MISSED_WAYPOINT);
  EXPECT_TRUE(loop.command.isZero());
}

TEST(Drive, AWaypointThatWasPushedPastIsTriedAgain) {
  FollowerOptions options;
  options.missed_waypoint = MissedPolicy::RETRY;
  ClosedLoop loop(options);
  loop.follower.start(pathOf({{0, 0}, {3, 0}, {6, 0}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.x() > 1.0; }));
  loop.vehicle.reset({Eigen::Vector3d(4.5, 2.0, 0.0), 0.0, {}});
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  EXPECT_EQ(loop.waypointsOf(Kind::REACHED), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(loop.waypointsOf(Kind::RETRY), (std::vector<int>{1}));
  EXPECT_TRUE(loop.follower.missedWaypoints().empty());
}

TEST(Drive, AVehicleThatIsHeldUpFailsAfterTheTimeoutForProgress) {
  FollowerOptions options;
  options.no_progress_timeout = 5.0;
  ClosedLoop loop(options);
  loop.follower.start(pathOf({{0, 0}, {3, 0}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.x() > 1.0; }));
  const double since = loop.vehicle.time();
  loop.each_step = [&] { loop.vehicle.reset({Eigen::Vector3d(1.0, 0.0, 0.0), 0.0, {}}); };
  ASSERT_TRUE(loop.runUntilState(FollowState::FAILED));
  EXPECT_EQ(loop.follower.status(), DriveStatus::NO_PROGRESS);
  EXPECT_NEAR(loop.vehicle.time() - since, 5.0, 0.5);
}

TEST(Drive, HoldsThePoseItArrivedAt) {
  ClosedLoop loop;
  loop.follower.start(pathOf({{2, 0, 0, 1}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  loop.vehicle.reset({Eigen::Vector3d(2.5, -0.3, 0.2), 0.5, {}});
  loop.run(10.0);
  EXPECT_LT((loop.pose().position - Eigen::Vector3d(2, 0, 0)).norm(), 0.05);
  EXPECT_NEAR(loop.pose().yaw, 1.0, 0.05);
  EXPECT_TRUE(loop.command.isZero());
}

TEST(Drive, LeavesAVehicleAloneThatItNeedNotHold) {
  FollowerOptions options;
  options.hold_pose = false;
  ClosedLoop loop(options);
  loop.follower.start(pathOf({{2, 0, 0, 1}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED));
  loop.vehicle.reset({Eigen::Vector3d(2.5, -0.3, 0.2), 0.5, {}});
  loop.run(3.0);
  EXPECT_EQ(loop.pose().position.x(), 2.5);
}

TEST(Drive, ThePathAheadIsWhatIsStillToBeDriven) {
  FollowerOptions options;
  options.lookahead = 2.5;
  ClosedLoop loop(options);
  loop.follower.start(pathOf({{0, 0}, {3, 0}, {3, 3}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntil([&] { return loop.pose().position.x() > 1.5; }));
  std::vector<Eigen::Vector3d> seen;
  loop.check = [&](const std::vector<Eigen::Vector3d>& ahead) {
    seen = ahead;
    return std::string();
  };
  const double x = loop.pose().position.x();
  loop.step();
  ASSERT_EQ(seen.size(), 4u);
  EXPECT_NEAR(seen[0].x(), x, 0.01) << "the vehicle";
  EXPECT_NEAR(seen[1].x(), x, 0.01) << "the nearest point of the path";
  EXPECT_TRUE(seen[2].isApprox(Eigen::Vector3d(3, 0, 0)));
  EXPECT_NEAR(seen[3].y(), 2.5 - (3.0 - x), 0.01);
}

// Over random paths, dense and sparse: arrives, reaches every waypoint, stays near the path, keeps
// the limits, and drives the same twice.
TEST(DriveLaw, StaysOnThePathInsideTheLimits) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    const double spacing = seed % 2 ? 0.3 : 4.0;
    std::uniform_real_distribution<double> turn(seed % 2 ? -0.8 : -3.1, seed % 2 ? 0.8 : 3.1);
    Path path;
    Eigen::Vector3d at(0, 0, 0);
    double heading = 0.0;
    for (int i = 0; i < (seed % 2 ? 60 : 12); ++i) {
      path.poses.push_back({at, heading});
      heading += turn(random);
      at += spacing * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.2 * turn(random));
    }
    FollowerOptions options;
    options.mode = seed % 5 ? FollowMode::CONTINUOUS : FollowMode::STOP_AT_EACH;
    ClosedLoop first(options), second(options);
    double farthest = 0.0;
    first.each_step = [&] {
      farthest = std::max(farthest, distanceTo(path, first.pose().position));
      const BodyVelocity& v = first.command;
      ASSERT_LE(std::hypot(v.surge, v.sway), options.max_speed + 1e-9);
      ASSERT_LE(std::abs(v.heave), options.max_vertical_speed + 1e-9);
      ASSERT_LE(std::abs(v.yaw_rate), options.max_yaw_rate + 1e-9);
    };
    first.follower.start(path, Join::FIRST);
    second.follower.start(path, Join::FIRST);
    ASSERT_TRUE(first.runUntilState(FollowState::ARRIVED)) << "seed " << seed;
    ASSERT_TRUE(second.runUntilState(FollowState::ARRIVED));
    EXPECT_LT(farthest, options.acceptance_radius) << "seed " << seed;
    EXPECT_TRUE(first.follower.missedWaypoints().empty()) << "seed " << seed;
    EXPECT_EQ(first.waypointsOf(Kind::REACHED).size(), path.poses.size()) << "seed " << seed;
    EXPECT_TRUE(first.pose().position == second.pose().position);
  }
}

}  // namespace
}  // namespace grid_path_planner::following
