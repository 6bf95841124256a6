// Vehicles that cannot go sideways: they follow paths, arrive with their heading, and are never commanded sideways.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "following/closed_loop.h"

namespace grid_path_planner::test {
namespace {

using base::BodyVelocity;
using following::DriveStatus;
using following::FollowerOptions;
using following::FollowState;
using following::Join;
using path::Path;
using vehicle::Description;
using vehicle::Drive;

Description wheelsOf(Drive drive) {
  Description vehicle;
  vehicle.drive = drive;
  vehicle.radius = 0.2;
  vehicle.max_speed = 0.5;
  vehicle.max_backward_speed = 0.2;
  vehicle.max_yaw_rate = 1.0;
  vehicle.max_acceleration = 0.5;
  vehicle.max_yaw_acceleration = 2.0;
  if (drive == Drive::CAR) vehicle.least_turning_radius = 0.5;
  return vehicle;
}

FollowerOptions optionsOf(const Description& vehicle) {
  FollowerOptions options;
  options.max_speed = vehicle.max_speed;
  options.max_yaw_rate = vehicle.max_yaw_rate;
  options.max_acceleration = vehicle.max_acceleration;
  options.max_yaw_acceleration = vehicle.max_yaw_acceleration;
  return options;
}

simulation::VehicleOptions simulated(const Description& vehicle) {
  simulation::VehicleOptions options;
  options.max_surge_speed = vehicle.max_speed;
  options.max_sway_speed = 0.0;
  options.max_heave_speed = 0.0;
  options.max_yaw_rate = vehicle.max_yaw_rate;
  options.max_acceleration = 2.0;
  options.max_yaw_acceleration = 6.0;
  options.response_time = 0.1;
  return options;
}

struct WheeledLoop : ClosedLoop {
  explicit WheeledLoop(Drive drive, const Eigen::Vector3d& at = {0, 0, 0}, double yaw = 0.0)
      : WheeledLoop(wheelsOf(drive), at, yaw) {}
  WheeledLoop(const Description& described, const Eigen::Vector3d& at, double yaw)
      : ClosedLoop(optionsOf(described), described, simulated(described), at, yaw) {
    each_step = [this, described] {
      sideways = std::max(sideways, std::abs(command.sway) + std::abs(command.heave));
      fastest = std::max(fastest, std::abs(command.surge));
      off.push_back((distanceTo(follower.path(), pose().position)));
      if (described.drive == Drive::CAR)
        narrowest = std::min(narrowest, std::abs(command.yaw_rate) < 1e-6
                                            ? 1e9
                                            : std::abs(command.surge / command.yaw_rate));
    };
  }

  double share(double quantile) {
    std::sort(off.begin(), off.end());
    return off[static_cast<std::size_t>(quantile * static_cast<double>(off.size() - 1))];
  }

  double sideways = 0.0, fastest = 0.0, narrowest = 1e9;
  std::vector<double> off;  // m, from the path
};

TEST(Differential, drivesRoundACornerAndArrivesWithItsHeading) {
  WheeledLoop loop(Drive::DIFFERENTIAL);
  loop.follower.start(pathOf({{0, 0, 0}, {3, 0, 0}, {3, 3, 0, M_PI}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED, 60.0)) << loop.follower.message();
  EXPECT_EQ(0.0, loop.sideways);
  EXPECT_LE(loop.follower.positionError(), 0.05);
  EXPECT_LE(loop.follower.yawError(), 0.05);
  EXPECT_LE(loop.share(0.99), 0.12) << "corners are cut by less than the pursuit distance";
}

// The table of issue 49: it drove well and never arrived, 0.07 to 0.18 m beside the goal.
TEST(Differential, arrivesFromBesideTheGoal) {
  for (const double beside : {-0.2, -0.1, -0.06, 0.06, 0.1, 0.2})
    for (const double before : {-0.3, 0.0, 0.1}) {
      WheeledLoop loop(Drive::DIFFERENTIAL, {2.0 + before, beside, 0.0}, 0.0);
      loop.follower.start(pathOf({{0, 0}, {2, 0}}), Join::NEAREST);
      ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED, 40.0))
          << beside << " m beside, " << before << ": " << loop.follower.message();
      EXPECT_EQ(0.0, loop.sideways);
    }
}

TEST(Differential, turnsOnTheSpotWhereThePathTurnsBack) {
  WheeledLoop loop(Drive::DIFFERENTIAL);
  loop.follower.start(pathOf({{0, 0}, {2, 0}, {0, 0.3, 0, M_PI}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED, 60.0)) << loop.follower.message();
  EXPECT_LE(loop.share(1.0), 0.25);
}

TEST(Differential, drivesBackwardsWhereThePathLooksBack) {
  WheeledLoop loop(Drive::DIFFERENTIAL);
  loop.follower.start(pathOf({{0, 0, 0, 0}, {-1, 0, 0, 0}}), Join::FIRST);
  double turned = 0.0;
  ASSERT_TRUE(loop.runUntil(
      [&] {
        turned = std::max(turned, std::abs(loop.pose().yaw));
        return loop.follower.state() == FollowState::ARRIVED;
      },
      30.0))
      << loop.follower.message();
  EXPECT_LT(turned, 0.1);
}

TEST(Differential, tracksLinesAndArcsWithinFiveCentimetres) {
  std::vector<std::vector<double>> poses;
  for (int i = 0; i <= 20; ++i) poses.push_back({0.1 * i, 0.0});
  for (int i = 1; i <= 60; ++i)
    poses.push_back({2.0 + 1.5 * std::sin(M_PI * i / 60), 1.5 - 1.5 * std::cos(M_PI * i / 60)});
  for (int i = 1; i <= 20; ++i) poses.push_back({2.0 - 0.1 * i, 3.0, 0.0, M_PI});
  WheeledLoop loop(Drive::DIFFERENTIAL);
  loop.follower.start(pathOf(poses), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED, 60.0)) << loop.follower.message();
  EXPECT_LE(loop.share(0.99), 0.05);
  EXPECT_NEAR(0.5, loop.fastest, 0.01);
}

// From any pose near a random path, by noisy poses, within its limits and never sideways.
TEST(DifferentialLaw, arrivesFromAnywhereNearARandomPath) {
  const unsigned seed = 2;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    std::vector<std::vector<double>> poses{{0, 0}};
    double direction = 3.0 * part(random);
    for (int k = 0; k < 8; ++k) {
      direction += 1.5 * part(random);
      const double length = 0.1 + std::abs(part(random));
      poses.push_back({poses.back()[0] + length * std::cos(direction),
                       poses.back()[1] + length * std::sin(direction), 0.0, 3.0 * part(random)});
    }
    WheeledLoop loop(Drive::DIFFERENTIAL, {part(random), part(random), 0.0}, 3.0 * part(random));
    loop.follower.start(pathOf(poses), Join::FIRST);
    std::normal_distribution<double> noise(0.0, 0.003);
    const auto each = loop.each_step;
    loop.each_step = [&] {
      each();
      loop.putAt(loop.vehicle.state().position + Eigen::Vector3d(noise(random), noise(random), 0));
    };
    ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED, 120.0)) << loop.follower.message();
    ASSERT_EQ(0.0, loop.sideways);
    ASSERT_LE(loop.fastest, 0.5 + 1e-9);
  }
}

TEST(Car, followsACurveOnNoNarrowerArcAndArrives) {
  std::vector<std::vector<double>> poses;
  for (int i = 0; i <= 20; ++i) poses.push_back({0.1 * i, 0.0});
  for (int i = 1; i <= 40; ++i)
    poses.push_back({2.0 + std::sin(M_PI * i / 40), 1.0 - std::cos(M_PI * i / 40)});
  for (int i = 1; i <= 20; ++i) poses.push_back({2.0 - 0.1 * i, 2.0, 0.0, M_PI});
  WheeledLoop loop(Drive::CAR);
  loop.follower.start(pathOf(poses), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED, 60.0)) << loop.follower.message();
  EXPECT_EQ(0.0, loop.sideways);
  EXPECT_GE(loop.narrowest, 0.45);
  EXPECT_LE(loop.share(0.99), 0.1);
  EXPECT_LE(loop.follower.yawError(), 0.2);
}

TEST(Wheeled, heightsDoNotCountWhereItCannotChangeThem) {
  Description described = wheelsOf(Drive::DIFFERENTIAL);
  described.base_height = 0.1;
  WheeledLoop loop(described, {0, 0, 0.1}, 0.0);
  loop.follower.start(pathOf({{0, 0, 0.1}, {2, 0, 0.0}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::ARRIVED, 30.0)) << loop.follower.message();
}

TEST(Undescribed, thatDoesNotGoSidewaysIsStoppedWithASentence) {
  ClosedLoop loop;
  simulation::VehicleOptions wheels;
  wheels.max_sway_speed = 0.0;
  loop.vehicle.setOptions(wheels);
  loop.follower.start(pathOf({{0, 1}, {5, 1}}), Join::FIRST);
  ASSERT_TRUE(loop.runUntilState(FollowState::FAILED, 30.0));
  EXPECT_EQ(DriveStatus::WRONG_DRIVE, loop.follower.status());
  EXPECT_NE(std::string::npos, loop.follower.message().find("drive: differential"));
  EXPECT_LT(loop.vehicle.time(), 6.0);
}

}  // namespace
}  // namespace grid_path_planner::test
