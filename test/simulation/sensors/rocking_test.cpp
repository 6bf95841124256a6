// Roll and pitch of the simulated vehicle: what they turn, and what they leave alone.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "support/rocking_drive.h"

namespace grid_path_planner::simulation {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Matrix3d, Eigen::Vector3d;
using test::drive, test::rocking;

TEST(Rocking, OfALevelVehiclePoseAndTwistAreToTheBitWhatTheyWereWithoutIt) {
  Vehicle vehicle;
  drive(vehicle, 20.0, 1, [](const Vehicle& v) {
    const VehicleState& state = v.state();
    const Isometry3d before =
        Eigen::Translation3d(state.position) * AngleAxisd(state.yaw, Vector3d::UnitZ());
    const Isometry3d pose = mapFromBase(state);
    ASSERT_EQ(std::memcmp(before.data(), pose.data(), 16 * sizeof(double)), 0);
    const BodyTwist twist = bodyTwist(state);
    ASSERT_EQ(twist.linear,
              Vector3d(state.velocity.surge, state.velocity.sway, state.velocity.heave));
    ASSERT_EQ(twist.angular, Vector3d(0.0, 0.0, state.velocity.yaw_rate));
    for (const double zero : {state.roll, state.pitch, twist.angular.x(), twist.angular.y()})
      ASSERT_FALSE(std::signbit(zero));
  });
}

TEST(Rocking, LeavesThePathAsItIs) {
  Vehicle level, rocked(rocking());
  std::vector<VehicleState> states;
  drive(level, 20.0, 2, [&](const Vehicle& v) { states.push_back(v.state()); });
  std::size_t i = 0;
  double largest = 0.0;
  drive(rocked, 20.0, 2, [&](const Vehicle& v) {
    ASSERT_EQ(v.state().position, states[i].position);
    ASSERT_EQ(v.state().yaw, states[i].yaw);
    ASSERT_EQ(v.state().velocity.surge, states[i++].velocity.surge);
    largest = std::max(largest, std::abs(v.state().roll));
  });
  EXPECT_NEAR(largest, 0.12, 1e-3) << "as far as it was told";
}

// A quarter of the period into the sine, the vehicle is at its largest roll.
TEST(Rocking, IsASineOfTheTime) {
  VehicleOptions options;
  options.roll_amplitude = 0.1;
  options.roll_period = 4.0;
  Vehicle vehicle(options);
  for (int i = 0; i < 100; ++i) vehicle.step();
  EXPECT_NEAR(vehicle.state().roll, 0.1, 1e-12);
  EXPECT_NEAR(vehicle.state().roll_rate, 0.0, 1e-12);
  EXPECT_EQ(vehicle.state().pitch, 0.0);
  vehicle.reset({Vector3d(5.0, 0.0, 0.0), 0.0});
  EXPECT_NEAR(vehicle.state().roll, 0.1, 1e-12) << "where it is put, the sea goes on";
}

// REP 103: positive pitch puts the bow down, positive roll the left side up.
TEST(Rocking, TurnsAboutTheAxesOfRep103) {
  VehicleState state;
  state.yaw = M_PI / 2;
  state.pitch = 0.1;
  const Vector3d bow = mapFromBase(state).linear() * Vector3d::UnitX();
  EXPECT_NEAR((bow - Vector3d(0.0, std::cos(0.1), -std::sin(0.1))).norm(), 0.0, 1e-12);
  state.pitch = 0.0;
  state.roll = 0.1;
  EXPECT_NEAR((mapFromBase(state).linear() * Vector3d::UnitY()).z(), std::sin(0.1), 1e-12);
}

// The twist is the derivative of the pose: compared with differences of it.
TEST(Rocking, TwistIsTheDerivativeOfThePose) {
  VehicleOptions options = rocking();
  options.time_step = 1e-4;
  Vehicle vehicle(options);
  VehicleState before = vehicle.state();
  int checked = 0;
  drive(vehicle, 3.0, 3, [&](const Vehicle& v) {
    const VehicleState& now = v.state();
    const Matrix3d turn = mapFromBase(before).linear().transpose() * mapFromBase(now).linear();
    const Vector3d motion =
        mapFromBase(before).linear().transpose() * (now.position - before.position);
    const AngleAxisd angle_axis(turn);
    const BodyTwist twist = bodyTwist(now);
    EXPECT_NEAR((motion / 1e-4 - twist.linear).norm(), 0.0, 1e-3);
    EXPECT_NEAR((angle_axis.angle() / 1e-4 * angle_axis.axis() - twist.angular).norm(), 0.0, 1e-3);
    before = now;
    ++checked;
  });
  EXPECT_EQ(checked, 30000);
}

}  // namespace
}  // namespace grid_path_planner::simulation
