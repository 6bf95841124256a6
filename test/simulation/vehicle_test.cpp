#include "grid_path_planner/simulation/vehicle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "grid_path_planner/base/errors.h"
#include "support/ascii_map.h"
#include "support/error_text.h"
#include "support/vehicle_run.h"

namespace grid_path_planner::simulation {

using base::BodyVelocity;
using base::InputError;
using grid::OccupancyGrid;
using grid::Origin;
using test::run;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void coast(Vehicle& vehicle, double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / vehicle.options().time_step));
  for (int i = 0; i < steps; ++i) vehicle.step();
}

std::shared_ptr<const OccupancyGrid> mapOf(const std::vector<std::string>& lines,
                                           const Origin& origin = {}) {
  return std::make_shared<OccupancyGrid>(test::AsciiMap(lines, 1.0, origin).map);
}

TEST(Vehicle, SpeedsUpAtItsAccelerationAndKeepsItsSpeed) {
  Vehicle vehicle;  // 1 m/s^2
  run(vehicle, {0.5, 0.0, 0.0, 0.0}, 0.25);
  EXPECT_NEAR(vehicle.state().velocity.surge, 0.25, 1e-9);
  EXPECT_NEAR(vehicle.state().position.x(), 0.5 * 0.25 * 0.25, 1e-9);
  run(vehicle, {0.5, 0.0, 0.0, 0.0}, 2.0);
  EXPECT_DOUBLE_EQ(vehicle.state().velocity.surge, 0.5);
}

TEST(Vehicle, FourAxesInTheBodyFrame) {
  Vehicle vehicle({}, {Eigen::Vector3d(1.0, 2.0, 3.0), M_PI / 2});
  run(vehicle, {0.4, 0.2, -0.1, 0.0}, 5.0);
  EXPECT_NEAR(vehicle.state().yaw, M_PI / 2, 1e-12);
  EXPECT_NEAR(vehicle.state().position.x(), 1.0 - 0.2 * (5.0 - 0.1), 1e-6);
  EXPECT_NEAR(vehicle.state().position.y(), 2.0 + 0.4 * (5.0 - 0.2), 1e-6);
  EXPECT_NEAR(vehicle.state().position.z(), 3.0 - 0.1 * (5.0 - 0.05), 1e-6);
}

TEST(Vehicle, TurnsAnticlockwiseAndItsYawStaysInOneTurn) {
  Vehicle vehicle;
  run(vehicle, {0.0, 0.0, 0.0, 1.0}, 4.0);
  EXPECT_NEAR(vehicle.state().yaw, 4.0 - 0.25 - 2.0 * M_PI, 1e-6);
}

TEST(Vehicle, DrivesACircle) {
  Vehicle vehicle;
  run(vehicle, {0.5, 0.0, 0.0, 0.5}, 3.0);
  const Eigen::Vector3d from = vehicle.state().position;
  run(vehicle, {0.5, 0.0, 0.0, 0.5}, 4.0 * M_PI);
  EXPECT_NEAR((vehicle.state().position - from).norm(), 0.0, 0.01);
}

TEST(Vehicle, CommandsBeyondItsLimitsAreHeldToThem) {
  Vehicle vehicle;
  run(vehicle, {1e9, -1e9, 1e9, -1e9}, 5.0);
  const BodyVelocity v = vehicle.state().velocity;
  EXPECT_DOUBLE_EQ(v.surge, 1.5);
  EXPECT_DOUBLE_EQ(v.sway, -1.0);
  EXPECT_DOUBLE_EQ(v.heave, 0.8);
  EXPECT_DOUBLE_EQ(v.yaw_rate, -1.5);
}

// A vehicle whose commander dies stops.
TEST(Vehicle, StopsWhenCommandsCease) {
  Vehicle vehicle;
  run(vehicle, {0.5, 0.3, 0.2, 0.5}, 3.0);
  coast(vehicle, 0.48);
  EXPECT_DOUBLE_EQ(vehicle.state().velocity.surge, 0.5) << "the command still holds";
  coast(vehicle, 0.52 + 0.02);
  EXPECT_TRUE(vehicle.state().velocity.isZero()) << "0.5 s later, and 0.5 s of braking";
}

TEST(Vehicle, AVehicleThatWasPutSomewhereStandsThere) {
  Vehicle vehicle;
  run(vehicle, {0.5, 0.3, 0.2, 0.5}, 1.0);
  vehicle.reset({Eigen::Vector3d(4.0, 5.0, 6.0), 1.0});
  coast(vehicle, 0.4);
  EXPECT_TRUE(vehicle.state().position == Eigen::Vector3d(4.0, 5.0, 6.0));
}

TEST(Vehicle, ANewCommandAfterTheSilenceWorks) {
  Vehicle vehicle;
  run(vehicle, {0.5, 0.0, 0.0, 0.0}, 1.0);
  coast(vehicle, 5.0);
  run(vehicle, {0.5, 0.0, 0.0, 0.0}, 1.0);
  EXPECT_DOUBLE_EQ(vehicle.state().velocity.surge, 0.5);
}

TEST(Vehicle, ACommandThatIsNotFiniteIsRefusedAndTheOneBeforeStays) {
  Vehicle vehicle;
  vehicle.command({0.5, 0.0, 0.0, 0.0});
  EXPECT_THROW(vehicle.command({kNaN, 0.0, 0.0, 0.0}), InputError);
  EXPECT_THROW(vehicle.command({0.0, 0.0, 0.0, HUGE_VAL}), InputError);
  coast(vehicle, 0.1);
  EXPECT_GT(vehicle.state().velocity.surge, 0.05);
}

TEST(Vehicle, ACommandRunsOutWithItsLastStepUnlessItIsToStop) {
  Vehicle vehicle;
  EXPECT_FALSE(vehicle.commandRunsOut());
  vehicle.command({0.5, 0.0, 0.0, 0.0});
  coast(vehicle, vehicle.options().cmd_vel_timeout - vehicle.options().time_step);
  EXPECT_TRUE(vehicle.commandRunsOut());
  vehicle.command({0.5, 0.0, 0.0, 0.0});
  EXPECT_FALSE(vehicle.commandRunsOut());
  vehicle.command({});
  coast(vehicle, vehicle.options().cmd_vel_timeout - vehicle.options().time_step);
  EXPECT_FALSE(vehicle.commandRunsOut());
}

TEST(Vehicle, BadOptionsAndStatesAreRefused) {
  VehicleOptions options;
  options.max_acceleration = kNaN;
  EXPECT_THROW(Vehicle{options}, InputError);
  options = {};
  options.cmd_vel_timeout = 0.05;
  options.time_step = 0.1;
  EXPECT_THROW(Vehicle{options}, InputError);
  EXPECT_THROW(Vehicle({}, {Eigen::Vector3d(kNaN, 0.0, 0.0), 0.0}), InputError);
  EXPECT_THROW(Vehicle({}, {Eigen::Vector3d::Zero(), kNaN}), InputError);
}

TEST(VehicleContact, TheDiscEndsAtTheObstacle) {
  Vehicle vehicle({}, {Eigen::Vector3d(0.5, 0.5, 0.0), 0.0});
  vehicle.setMap(mapOf({"...#"}));
  run(vehicle, {1.0, 0.0, 0.0, 0.0}, 10.0);
  EXPECT_NEAR(vehicle.state().position.x(), 3.0 - 0.3, 1e-6);
  EXPECT_EQ(vehicle.state().velocity.surge, 0.0);
  EXPECT_TRUE(vehicle.inContact());
  EXPECT_EQ(vehicle.contacts(), 1) << "pushing on is the same contact";
}

TEST(VehicleContact, EachRunAgainstTheWallCounts) {
  Vehicle vehicle({}, {Eigen::Vector3d(1.5, 0.5, 0.0), 0.0});
  vehicle.setMap(mapOf({"...#"}));
  for (int i = 1; i <= 3; ++i) {
    run(vehicle, {1.0, 0.0, 0.0, 0.0}, 3.0);
    EXPECT_EQ(vehicle.contacts(), i);
    run(vehicle, {-0.2, 0.0, 0.0, 0.0}, 1.0);
    EXPECT_FALSE(vehicle.inContact());
  }
}

TEST(VehicleContact, PassesAnObstacleAtMoreThanItsRadius) {
  Vehicle vehicle({}, {Eigen::Vector3d(0.5, 0.69, 0.0), 0.0});
  vehicle.setMap(mapOf({"......",  //
                        "..#..."}));
  run(vehicle, {1.0, 0.0, 0.0, 0.0}, 5.0);
  EXPECT_EQ(vehicle.contacts(), 0);
  vehicle.reset({Eigen::Vector3d(0.5, 0.71, 0.0), 0.0});
  run(vehicle, {1.0, 0.0, 0.0, 0.0}, 5.0);
  EXPECT_EQ(vehicle.contacts(), 1);
}

TEST(VehicleContact, TurnsAndDivesWhileItTouches) {
  Vehicle vehicle({}, {Eigen::Vector3d(2.5, 0.5, 0.0), 0.0});
  vehicle.setMap(mapOf({"...#"}));
  run(vehicle, {1.0, 0.0, -0.5, 0.0}, 4.0);
  EXPECT_LT(vehicle.state().position.z(), -1.5);
  run(vehicle, {0.0, 0.0, 0.0, 1.0}, 2.0);
  EXPECT_GT(vehicle.state().yaw, 1.0);
}

TEST(VehicleContact, AVehicleThatWasPutIntoAnObstacleMayLeaveIt) {
  Vehicle vehicle({}, {Eigen::Vector3d(2.9, 0.5, 0.0), 0.0});
  vehicle.setMap(mapOf({"...#"}));
  run(vehicle, {-0.5, 0.0, 0.0, 0.0}, 2.0);
  EXPECT_LT(vehicle.state().position.x(), 2.5);
  EXPECT_EQ(vehicle.contacts(), 0);
}

TEST(VehicleContact, AFastVehicleDoesNotJumpOverAWall) {
  VehicleOptions options;
  options.max_surge_speed = 100.0;
  options.max_acceleration = 1000.0;
  options.time_step = 0.1;
  Vehicle vehicle(options, {Eigen::Vector3d(0.5, 0.5, 0.0), 0.0});
  vehicle.setMap(mapOf({"....#......."}));
  run(vehicle, {100.0, 0.0, 0.0, 0.0}, 1.0);
  EXPECT_NEAR(vehicle.state().position.x(), 3.7, 1e-6);
}

TEST(VehicleContact, OutsideTheMapThereAreNoObstacles) {
  Vehicle vehicle({}, {Eigen::Vector3d(-1e9, 1e9, 0.0), 0.0});
  vehicle.setMap(mapOf({"###"}));
  run(vehicle, {1.0, 0.0, 0.0, 0.0}, 1.0);
  EXPECT_EQ(vehicle.contacts(), 0);
}

// Whatever is commanded on whatever map: speeds and accelerations inside the limits, the disc never
// in an occupied cell, and the same commands give the same path.
TEST(VehicleLaw, LimitsWallsAndRepeatability) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::string> lines(12, std::string(12, '.'));
    for (auto& line : lines)
      for (char& letter : line)
        if (random() % 8 == 0) letter = '#';
    lines[6][6] = '.';
    const auto map = mapOf(lines, {-6.0, -7.0, 0.3 * seed});
    const Eigen::Vector2d start = map->geometry().centre({6, 6});
    const VehicleState initial{Eigen::Vector3d(start.x(), start.y(), 0.0), 0.0};
    Vehicle first({}, initial), second({}, initial);
    first.setMap(map);
    second.setMap(map);
    std::uniform_real_distribution<double> number(-3.0, 3.0);
    for (int i = 0; i < 2000; ++i) {
      const BodyVelocity before = first.state().velocity;
      if (i % 40 == 0) {
        const BodyVelocity command{number(random), number(random), number(random), number(random)};
        first.command(command);
        second.command(command);
      }
      first.step();
      second.step();
      const BodyVelocity& v = first.state().velocity;
      ASSERT_LE(std::abs(v.surge), 1.5);
      ASSERT_LE(std::abs(v.heave - before.heave), 0.01 + 1e-12);
      ASSERT_LE(std::abs(v.yaw_rate - before.yaw_rate), 0.02 + 1e-12);
      const Eigen::Vector2d at = first.state().position.head<2>();
      for (double angle = 0.0; angle < 2.0 * M_PI; angle += 0.2) {
        const Eigen::Vector2d rim = at + 0.299 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        const auto cell = map->geometry().cellAt(rim);
        ASSERT_FALSE(cell && (*map)[*cell] == 100) << "seed " << seed << ", step " << i;
      }
    }
    EXPECT_TRUE(first.state().position == second.state().position);
    EXPECT_EQ(first.state().yaw, second.state().yaw);
    EXPECT_EQ(first.contacts(), second.contacts());
  }
}

// A map of 1000x1000 cells of 1e-6 m held a step, and the simulator's end, for hours.
TEST(Vehicle, RefusesCellsThatAStepWouldLookAtForTooLong) {
  Vehicle vehicle({}, {Eigen::Vector3d(1.5, 0.5, 0.0), 0.0});
  vehicle.setMap(mapOf({"...#"}));
  const auto tiny = std::make_shared<OccupancyGrid>(grid::GridGeometry(1000, 1000, 1e-6));
  EXPECT_EQ(test::errorText([&] { vehicle.setMap(tiny); }),
            "cells of 1e-06 m are too small for vehicle_radius 0.3 m and time_step 0.01 s: a step "
            "would look at more than 100000000 cells");
  run(vehicle, {1.0, 0.0, 0.0, 0.0}, 3.0);
  EXPECT_EQ(vehicle.contacts(), 1) << "the map before holds";
}

TEST(Vehicle, RefusesARadiusThatItsMapIsTooFineFor) {
  Vehicle vehicle;
  vehicle.setMap(std::make_shared<OccupancyGrid>(test::AsciiMap({"...."}, 0.01).map));
  VehicleOptions options;
  options.vehicle_radius = 100.0;
  EXPECT_THROW(vehicle.setOptions(options), InputError);
  EXPECT_EQ(vehicle.options().vehicle_radius, 0.3);
  options.vehicle_radius = 5.0;
  EXPECT_NO_THROW(vehicle.setOptions(options)) << "a ship on cells of a centimetre";
  vehicle.setMap(nullptr);
  options.vehicle_radius = 100.0;
  EXPECT_NO_THROW(vehicle.setOptions(options));
}

}  // namespace
}  // namespace grid_path_planner::simulation
