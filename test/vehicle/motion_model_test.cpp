// How vehicles move: arcs, what drives cannot do, and laws against Euler's integration in small steps.
#include "vehicle/motion_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/random_vehicles.h"
#include "vehicle/commanded_velocity.h"

namespace grid_path_planner::vehicle {
namespace {

using base::BodyVelocity;

TEST(AlongArc, quarterOfACircleToTheLeft) {
  PlanarState state;
  state.velocity = {1.0, 0.0, 0.0, M_PI / 2};
  const PlanarState end = alongArc(state, 1.0);
  EXPECT_NEAR(2.0 / M_PI, end.position.x(), 1e-12);
  EXPECT_NEAR(2.0 / M_PI, end.position.y(), 1e-12);
  EXPECT_NEAR(M_PI / 2, end.yaw, 1e-12);
}

TEST(AlongArc, sidewaysIsTheSameArcTurned) {
  PlanarState state;
  state.velocity = {0.0, 1.0, 0.0, M_PI / 2};
  const PlanarState end = alongArc(state, 1.0);
  EXPECT_NEAR(-2.0 / M_PI, end.position.x(), 1e-12);
  EXPECT_NEAR(2.0 / M_PI, end.position.y(), 1e-12);
}

// Driven on and back again by the reversed velocity it is where it was.
TEST(AlongArc, isItsOwnInverse) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  for (int i = 0; i < 10000; ++i) {
    PlanarState state;
    state.position = {any(random), any(random)};
    state.yaw = any(random);
    state.velocity = {any(random), any(random), 0.0, any(random)};
    PlanarState there = alongArc(state, 0.7);
    there.velocity = {-there.velocity.surge, -there.velocity.sway, 0.0, -there.velocity.yaw_rate};
    const PlanarState back = alongArc(there, 0.7);
    ASSERT_NEAR(0.0, (back.position - state.position).norm(), 1e-12);
    ASSERT_NEAR(state.yaw, back.yaw, 1e-12);
  }
}

TEST(MotionModel, noDriveDoesWhatItCannot) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-5.0, 5.0);
  for (int i = 0; i < 20000; ++i) {
    const Description vehicle = test::randomDescription(random);
    const MotionModel model(vehicle);
    PlanarState state;
    state.velocity = model.feasible({any(random), any(random), any(random), any(random)});
    const BodyVelocity command{any(random), any(random), any(random), any(random)};
    const BodyVelocity v = model.advanced(state, command, 0.05).velocity;
    ASSERT_LE(v.surge, vehicle.max_speed);
    ASSERT_GE(v.surge, -vehicle.max_backward_speed);
    ASSERT_LE(std::abs(v.sway), vehicle.max_sideways_speed);
    ASSERT_LE(std::abs(v.yaw_rate), vehicle.max_yaw_rate);
    ASSERT_LE(std::abs(v.surge - state.velocity.surge), vehicle.max_acceleration * 0.05 + 1e-12);
    if (vehicle.drive != Drive::CAR) continue;
    ASSERT_LE(std::abs(v.yaw_rate) * vehicle.least_turning_radius, std::abs(v.surge) + 1e-12);
  }
}

// Euler's integration in steps of 0.1 ms, written down anew, ends where the model's steps of 50 ms do.
TEST(MotionModel, agreesWithEulersIntegration) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  for (int i = 0; i < 300; ++i) {
    Description vehicle = test::randomDescription(random);
    vehicle.drive = Drive::OMNIDIRECTIONAL;
    vehicle.max_sideways_speed = 1.0;
    const MotionModel model(vehicle);
    const BodyVelocity command = model.feasible({any(random), any(random), 0.0, any(random)});
    PlanarState state;
    double x = 0.0, y = 0.0, yaw = 0.0, surge = 0.0, sway = 0.0, rate = 0.0;
    constexpr double kEuler = 1e-4;
    const auto step = [&](double value, double target, double most) {
      const double tau = vehicle.time_constant;
      const double wish = tau > 0.0 ? (target - value) / tau : (target - value) / kEuler;
      return value + kEuler * std::clamp(wish, -most, most);
    };
    for (int k = 0; k < 20; ++k) state = model.advanced(state, command, 0.05);
    for (int k = 0; k < 10000; ++k) {
      x += kEuler * (std::cos(yaw) * surge - std::sin(yaw) * sway);
      y += kEuler * (std::sin(yaw) * surge + std::cos(yaw) * sway);
      yaw += kEuler * rate;
      surge = step(surge, command.surge, vehicle.max_acceleration);
      sway = step(sway, command.sway, vehicle.max_acceleration);
      rate = step(rate, command.yaw_rate, vehicle.max_yaw_acceleration);
    }
    // What a step's velocity, which changes evenly, leaves of the exponential.
    ASSERT_NEAR(x, state.position.x(), 0.02) << "seed 5, vehicle " << i;
    ASSERT_NEAR(y, state.position.y(), 0.02) << "seed 5, vehicle " << i;
    ASSERT_NEAR(yaw, state.yaw, 0.02) << "seed 5, vehicle " << i;
  }
}

TEST(CommandedVelocity, followsACommandAfterTheDeadTime) {
  Description vehicle;
  vehicle.drive = Drive::DIFFERENTIAL;
  vehicle.radius = 0.2;
  vehicle.max_speed = vehicle.max_yaw_rate = 1.0;
  vehicle.max_acceleration = vehicle.max_yaw_acceleration = 100.0;
  vehicle.dead_time = 0.25;
  vehicle.time_constant = 0.0;
  CommandedVelocity commanded(vehicle);
  commanded.advanceTo(10.0);
  commanded.sent({0.5, 0.0, 0.0, 0.0});
  commanded.advanceTo(10.1);
  commanded.sent({0.8, 0.0, 0.0, 0.0});
  EXPECT_EQ(0.0, commanded.velocity().surge);
  const std::vector<TimedCommand> pending = commanded.pending();
  ASSERT_EQ(2u, pending.size());
  EXPECT_EQ(0.0, pending[0].command.surge);
  EXPECT_NEAR(0.15, pending[0].seconds, 1e-9);
  EXPECT_EQ(0.5, pending[1].command.surge);
  EXPECT_NEAR(0.1, pending[1].seconds, 1e-9);
  commanded.advanceTo(10.3);
  EXPECT_NEAR(0.5, commanded.velocity().surge, 1e-9);
  commanded.advanceTo(10.4);
  EXPECT_NEAR(0.8, commanded.velocity().surge, 1e-9);
  commanded.advanceTo(9.0);
  EXPECT_EQ(0.0, commanded.velocity().surge) << "time went back: the vehicle is taken to stand";
}

}  // namespace
}  // namespace grid_path_planner::vehicle
