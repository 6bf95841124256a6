// A vehicle that cannot sway drives where it looks.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "avoidance/drawn_world.h"
#include "avoidance/seen_space.h"
#include "avoidance/simulated_flight.h"
#include "avoidance/steering/steering.h"

namespace grid_path_planner::avoidance {
namespace {

using Eigen::Vector3d;

PilotOptions groundOptions() {
  PilotOptions options = flyingOptions();
  options.elevation = options.sway = false;
  return options;
}

// It looked round the corner ahead, more than 25 degrees beside its path, and so did not drive: for good, in forest_maze
// before its first corner.
TEST(GroundVehicle, DrivesAlongAnyPathThatIsOpenOnceItHasTurned) {
  const PilotOptions options = groundOptions();
  const OpenSpace space = seenSpace(options.d_safe);
  std::mt19937 random(5);
  std::uniform_real_distribution<> length(0.5, 1.5), angle(-M_PI, M_PI);
  for (int i = 0; i < 50; ++i) {
    Points points = {Vector3d::Zero()};
    for (int k = 0; k < 3; ++k) {
      const double towards = angle(random);
      points.push_back(points.back() +
                       length(random) * Vector3d(std::cos(towards), std::sin(towards), 0.0));
    }
    FlownPath path;
    path.set(points, std::nullopt);
    Motion motion;
    Steering steering;
    for (int turn = 0; turn < 400; ++turn) {
      steering = steerSafely(motion, path, space, {}, options, std::nullopt);
      motion.yaw += 0.05 * steering.velocity.yaw_rate;
    }
    EXPECT_GT(steering.velocity.surge, 0.1) << i;
    const Vector3d ahead(std::cos(motion.yaw), std::sin(motion.yaw), 0.0);
    EXPECT_GT(ahead.dot((points[1] - points[0]).normalized()), 0.9) << i;
  }
}

TEST(GroundVehicle, ComesRoundTheCornersOfAMaze) {
  FlightSetup setup;
  setup.world = worldOf(drawnMeshes({"#######",  //
                                     "#     #",  //
                                     "# ### #",  //
                                     "# #   #",  //
                                     "#######"},
                                    2.0));
  setup.options = groundOptions();
  setup.start = {3.0, -3.0, 1.5};
  setup.waypoints = {{9.0, -7.0, 1.5}};
  setup.seconds = 120.0;
  const FlightResult result = fly(setup);
  EXPECT_EQ(result.status, PilotStatus::ARRIVED) << result.sentence;
  EXPECT_EQ(result.contacts, 0);
}

}  // namespace
}  // namespace grid_path_planner::avoidance
