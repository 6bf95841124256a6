// Which commands are let through: pictures, and the law that none of their motions touches anything.
#include "vehicle/motion_check.h"

#include <gtest/gtest.h>

#include <random>

#include "support/ascii_map.h"
#include "support/random_footprints.h"
#include "support/random_vehicles.h"

namespace grid_path_planner::vehicle {
namespace {

using base::BodyVelocity;
using grid::OccupancyGrid;

Description quickWheels() {
  Description vehicle;
  vehicle.drive = Drive::DIFFERENTIAL;
  vehicle.radius = 0.2;
  vehicle.max_speed = vehicle.max_backward_speed = 1.0;
  vehicle.max_yaw_rate = 2.0;
  vehicle.max_acceleration = 1.0;
  vehicle.max_yaw_acceleration = 4.0;
  vehicle.dead_time = vehicle.time_constant = 0.0;
  return vehicle;
}

MotionCheck checkOf(const Description& vehicle, const OccupancyGrid& map, const PlanarState& state,
                    std::vector<TimedCommand> pending = {}) {
  return MotionCheck(vehicle, map.geometry(), mapObstacles(map, {}, false),
                     {state, std::move(pending), 0.05});
}

PlanarState stateAt(double x, double y, double yaw, const BodyVelocity& velocity = {}) {
  PlanarState state;
  state.position = {x, y};
  state.yaw = yaw;
  state.velocity = velocity;
  return state;
}

// Row 0 is below; x 2 to 3 is occupied.
const test::AsciiMap kWall({"..#.", "..#."});

TEST(MotionCheck, lengthOfTheBrakingDecides) {
  const Description vehicle = quickWheels();
  const BodyVelocity fast{1.0, 0.0, 0.0, 0.0};
  // From 1 m/s it takes 0.5 m to stand, and one period more; the wall is 0.2 m nearer than its edge.
  EXPECT_FALSE(checkOf(vehicle, kWall.map, stateAt(1.2, 1.0, 0.0, fast)).contactOf(fast));
  EXPECT_TRUE(checkOf(vehicle, kWall.map, stateAt(1.27, 1.0, 0.0, fast)).contactOf(fast));
  EXPECT_FALSE(checkOf(vehicle, kWall.map, stateAt(1.27, 1.0, 0.0, fast)).contactOf({}));
}

TEST(MotionCheck, theDeadTimeIsDrivenFirst) {
  const Description vehicle = quickWheels();
  const BodyVelocity fast{1.0, 0.0, 0.0, 0.0};
  const PlanarState state = stateAt(1.1, 1.0, 0.0, fast);
  EXPECT_FALSE(checkOf(vehicle, kWall.map, state).contactOf(fast));
  EXPECT_TRUE(checkOf(vehicle, kWall.map, state, {{fast, 0.3}}).contactOf(fast));
}

TEST(MotionCheck, namesTheCellThatIsTouched) {
  const BodyVelocity fast{1.0, 0.0, 0.0, 0.0};
  const auto contact =
      checkOf(quickWheels(), kWall.map, stateAt(1.7, 0.5, 0.0, fast)).contactOf(fast);
  ASSERT_TRUE(contact);
  EXPECT_EQ((grid::Cell{2, 0}), contact->cell);
}

TEST(MotionCheck, aLongVehicleDoesNotTurnIntoTheWallBesideIt) {
  Description vehicle = quickWheels();
  vehicle.radius = 0.0;
  vehicle.outline = "[[0.9, 0.2], [-0.9, 0.2], [-0.9, -0.2], [0.9, -0.2]]";
  const PlanarState beside = stateAt(1.7, 1.0, M_PI / 2, {0.0, 0.0, 0.0, 1.0});
  EXPECT_TRUE(checkOf(vehicle, kWall.map, beside).contactOf({0.0, 0.0, 0.0, 1.0}));
  const PlanarState standing = stateAt(1.7, 1.0, M_PI / 2);
  EXPECT_FALSE(checkOf(vehicle, kWall.map, standing).contactOf({0.3, 0.0, 0.0, 0.0}));
  const PlanarState away = stateAt(1.0, 1.0, M_PI / 2);
  EXPECT_FALSE(checkOf(vehicle, kWall.map, away).contactOf({0.0, 0.0, 0.0, 0.3}));
}

TEST(MotionCheck, whoIsTooNearLeavesAndComesNoNearer) {
  for (const bool round : {true, false}) {
    Description vehicle = quickWheels();
    if (!round) {
      vehicle.radius = 0.0;
      vehicle.outline = "[[0.2, 0.2], [-0.2, 0.2], [-0.2, -0.2], [0.2, -0.2]]";
    }
    const PlanarState near = stateAt(1.9, 1.0, 0.0);
    EXPECT_TRUE(checkOf(vehicle, kWall.map, near).contactOf({0.1, 0.0, 0.0, 0.0}));
    EXPECT_FALSE(checkOf(vehicle, kWall.map, near).contactOf({-0.3, 0.0, 0.0, 0.0}));
    EXPECT_FALSE(checkOf(vehicle, kWall.map, near).contactOf({}));
    const PlanarState inside = stateAt(2.5, 1.0, 0.0);
    EXPECT_TRUE(checkOf(vehicle, kWall.map, inside).contactOf({-0.3, 0.0, 0.0, 0.0}));
  }
}

TEST(MotionCheck, unknownCellsAndTheBorderCountWhereTheyAreObstacles) {
  const test::AsciiMap map({"..?", "..?"});
  const PlanarState state = stateAt(1.75, 1.0, 0.0, {0.3, 0.0, 0.0, 0.0});
  const BodyVelocity slow{0.3, 0.0, 0.0, 0.0};
  const auto contactWith = [&](bool unknown, const PlanarState& at) {
    return MotionCheck(quickWheels(), map.map.geometry(), mapObstacles(map.map, {}, unknown),
                       {at, {}, 0.05})
        .contactOf(slow)
        .has_value();
  };
  EXPECT_FALSE(contactWith(false, state));
  EXPECT_TRUE(contactWith(true, state));
  EXPECT_FALSE(contactWith(false, stateAt(0.5, 1.75, M_PI / 2, {0.3, 0.0, 0.0, 0.0})));
  EXPECT_TRUE(contactWith(true, stateAt(0.5, 1.75, M_PI / 2, {0.3, 0.0, 0.0, 0.0})));
}

TEST(MotionCheck, keepsOffByWhatTheVehicleMayDrift) {
  Description vehicle = quickWheels();
  const PlanarState state = stateAt(1.79, 1.0, M_PI / 2, {0.3, 0.0, 0.0, 0.0});
  const BodyVelocity slow{0.3, 0.0, 0.0, 0.0};
  EXPECT_FALSE(checkOf(vehicle, kWall.map, state).contactOf(slow));
  vehicle.drift = 0.1;
  EXPECT_FALSE(checkOf(vehicle, kWall.map, state).contactOf(slow)) << "it comes no nearer";
  const PlanarState towards = stateAt(1.74, 1.0, M_PI / 2 - 0.5, {0.3, 0.0, 0.0, 0.0});
  EXPECT_FALSE(checkOf(quickWheels(), kWall.map, towards).contactOf(slow));
  EXPECT_TRUE(checkOf(vehicle, kWall.map, towards).contactOf(slow));
}

// The motion as the vehicle makes it, in steps of 2 ms, judged by Boost.Geometry at each 10 ms.
double deepestOf(const Description& vehicle, const OccupancyGrid& map, PlanarState state,
                 const std::vector<TimedCommand>& commands) {
  const MotionModel model(vehicle);
  double deepest = 0.0;
  int steps = 0;
  for (const TimedCommand& each : commands)
    for (double left = each.seconds; left > 1e-9; left -= 0.002) {
      state = model.advanced(state, each.command, std::min(left, 0.002));
      if (++steps % 5 == 0) deepest = std::max(deepest, test::depthInCells(vehicle, state, map));
    }
  return deepest;
}

TEST(MotionCheckLaw, whatIsLetThroughTouchesNothing) {
  const unsigned seed = 49;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0), any(-1.5, 1.5);
  int free = 0, refused = 0, needlessly = 0;
  while (free + refused < 1200) {
    const OccupancyGrid map = test::randomRooms(random, any(random));
    const Description vehicle = test::randomDescription(random);
    const MotionModel model(vehicle);
    PlanarState state;
    state.position = map.geometry().worldFromGrid({60.0 * part(random), 60.0 * part(random)});
    state.yaw = 2.0 * any(random);
    if (test::depthInCells(vehicle, state, map) > 0.0) continue;
    state.velocity = model.feasible({any(random), any(random), 0.0, any(random)});
    const BodyVelocity before = model.feasible({any(random), any(random), 0.0, any(random)});
    const BodyVelocity command = model.feasible({any(random), any(random), 0.0, any(random)});
    const std::vector<TimedCommand> pending = {{before, vehicle.dead_time}};
    const auto contact = checkOf(vehicle, map, state, pending).contactOf(command);
    const double deepest =
        deepestOf(vehicle, map, state, {{before, vehicle.dead_time}, {command, 0.05}, {{}, 4.0}});
    if (!contact) {
      ASSERT_LE(deepest, 0.0) << "case " << free + refused;
      ++free;
    } else {
      ++refused;
      Description larger = vehicle;  // what would be touched by one that is 3 cm larger
      if (larger.radius > 0.0) larger.radius += 0.03;
      if (deepest == 0.0 && larger.radius > 0.0 &&
          deepestOf(larger, map, state,
                    {{before, vehicle.dead_time}, {command, 0.05}, {{}, 4.0}}) == 0.0)
        ++needlessly;
    }
  }
  EXPECT_GT(free, 200);
  EXPECT_GT(refused, 100);
  EXPECT_EQ(0, needlessly) << "of " << refused << ": refused though a larger vehicle passes";
}

}  // namespace
}  // namespace grid_path_planner::vehicle
