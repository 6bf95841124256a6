// The vehicle among the surfaces of a world.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "grid_path_planner/simulation/vehicle.h"
#include "support/ascii_map.h"
#include "support/vehicle_run.h"

namespace grid_path_planner::simulation {

using base::BodyVelocity;
using grid::OccupancyGrid;
using test::run;

namespace {

using Eigen::Vector3d;

TriangleMesh boxAt(const std::string& name, const Vector3d& centre, const Vector3d& size) {
  return boxMesh(name, size).moved(Eigen::Isometry3d(Eigen::Translation3d(centre)));
}

// A post as thick as the vehicle, 3 m ahead of the origin, and a floor 2 m below it.
std::shared_ptr<const World> postAndFloor() {
  return std::make_shared<const World>(
      std::vector<TriangleMesh>{boxAt("post", {3.0, 0.0, 0.0}, {0.4, 0.4, 2.0}),
                                boxAt("floor", {0.0, 0.0, -2.5}, {20.0, 20.0, 1.0})});
}

Vehicle vehicleIn(const std::shared_ptr<const World>& world, const Vector3d& position,
                  const VehicleOptions& options = {}) {
  Vehicle vehicle(options, {position, 0.0});
  vehicle.setWorld(world);
  return vehicle;
}

TEST(VehicleInWorld, TheSphereEndsAtTheSurfaceAndSaysWhatItIs) {
  Vehicle vehicle = vehicleIn(postAndFloor(), Vector3d::Zero());
  EXPECT_EQ(vehicle.touched(), "");
  run(vehicle, {1.0, 0.0, 0.0, 0.0}, 5.0);
  EXPECT_NEAR(vehicle.state().position.x(), 3.0 - 0.2 - 0.3, 1e-6);
  EXPECT_TRUE(vehicle.state().velocity.isZero());
  EXPECT_EQ(vehicle.contacts(), 1) << "pushing on is the same contact";
  EXPECT_EQ(vehicle.touched(), "post");
}

TEST(VehicleInWorld, DepthsCount) {
  Vehicle vehicle = vehicleIn(postAndFloor(), {0.0, 0.0, 1.31});
  run(vehicle, {1.0, 0.0, 0.0, 0.0}, 6.0);
  EXPECT_EQ(vehicle.contacts(), 0) << "passes above the post";
  vehicle.reset({{0.0, 0.0, 1.29}, 0.0});
  run(vehicle, {1.0, 0.0, 0.0, 0.0}, 6.0);
  EXPECT_EQ(vehicle.contacts(), 1);
}

TEST(VehicleInWorld, HeavesDownOntoTheFloorAndUpAgain) {
  Vehicle vehicle = vehicleIn(postAndFloor(), Vector3d::Zero());
  run(vehicle, {0.0, 0.0, -0.5, 0.0}, 6.0);
  EXPECT_NEAR(vehicle.state().position.z(), -1.7, 1e-6);
  EXPECT_EQ(vehicle.touched(), "floor");
  run(vehicle, {0.0, 0.0, 0.5, 0.0}, 2.0);
  EXPECT_FALSE(vehicle.inContact());
  EXPECT_GT(vehicle.state().position.z(), -1.2);
  run(vehicle, {0.0, 0.0, -0.5, 0.0}, 6.0);
  EXPECT_EQ(vehicle.contacts(), 2);
}

TEST(VehicleInWorld, AfterATouchItMovesAlongTheSurfaceAndTurns) {
  Vehicle vehicle = vehicleIn(postAndFloor(), Vector3d::Zero());
  run(vehicle, {0.0, 0.0, -0.5, 0.0}, 6.0);
  run(vehicle, {0.0, 0.4, 0.0, 0.0}, 3.0);
  EXPECT_NEAR(vehicle.state().position.y(), 0.4 * (3.0 - 0.2), 0.01);
  EXPECT_EQ(vehicle.contacts(), 1);
  run(vehicle, {0.0, 0.0, -0.5, 0.5}, 2.0);
  EXPECT_NEAR(vehicle.state().yaw, 0.5 * (2.0 - 0.125), 0.01) << "pressed to the floor";
}

TEST(VehicleInWorld, FastOnesDoNotJumpThroughThinSurfaces) {
  VehicleOptions options;
  options.max_surge_speed = 100.0;
  options.max_acceleration = 1000.0;
  options.time_step = 0.1;
  const auto sheet = std::make_shared<const World>(std::vector<TriangleMesh>{
      planeMesh("sheet", Vector3d::UnitX(), {4.0, 4.0})
          .moved(Eigen::Isometry3d(Eigen::Translation3d(8.0, 0.0, 0.0)))});
  for (const double y : {0.0, 2.2, 2.29}) {  // also where only its rim is met
    Vehicle vehicle = vehicleIn(sheet, {0.0, y, 0.0}, options);
    run(vehicle, {100.0, 0.0, 0.0, 0.0}, 1.0);
    EXPECT_LT(vehicle.state().position.x(), 8.0) << y;
    EXPECT_EQ(vehicle.touched(), "sheet");
  }
  Vehicle beside = vehicleIn(sheet, {0.0, 2.31, 0.0}, options);
  run(beside, {100.0, 0.0, 0.0, 0.0}, 1.0);
  EXPECT_EQ(beside.contacts(), 0);
}

TEST(VehicleInWorld, WhereItWasPutIntoSomethingItMayLeaveInAnyDirection) {
  for (const BodyVelocity& velocity :
       {BodyVelocity{0.5, 0.0, 0.0, 0.0}, BodyVelocity{0.0, -0.5, 0.0, 0.0},
        BodyVelocity{0.0, 0.0, 0.5, 0.0}}) {
    Vehicle vehicle = vehicleIn(postAndFloor(), {2.9, 0.1, 0.0});
    run(vehicle, velocity, 5.0);
    EXPECT_EQ(vehicle.contacts(), 0);
    EXPECT_FALSE(postAndFloor()->nearest(vehicle.state().position, 0.3));
  }
}

TEST(VehicleInWorld, MapAndWorldBothHoldItUp) {
  Vehicle vehicle = vehicleIn(postAndFloor(), {0.5, 0.5, 0.0});
  vehicle.setMap(std::make_shared<OccupancyGrid>(test::AsciiMap({"..#"}).map));
  run(vehicle, {1.0, 0.0, 0.0, 0.0}, 5.0);
  EXPECT_NEAR(vehicle.state().position.x(), 1.7, 1e-6);
  EXPECT_EQ(vehicle.touched(), "projected_map");
  run(vehicle, {-0.2, 0.0, 0.0, 0.0}, 1.0);
  run(vehicle, {0.0, 0.0, -0.5, 0.0}, 6.0);
  EXPECT_EQ(vehicle.contacts(), 2);
  EXPECT_EQ(vehicle.touched(), "floor");
}

TEST(VehicleInWorld, AWorldThatIsTakenAwayHoldsNothing) {
  Vehicle vehicle = vehicleIn(postAndFloor(), Vector3d::Zero());
  run(vehicle, {1.0, 0.0, 0.0, 0.0}, 5.0);
  vehicle.setWorld(nullptr);
  EXPECT_FALSE(vehicle.inContact());
  EXPECT_EQ(vehicle.contacts(), 1);
  run(vehicle, {1.0, 0.0, 0.0, 0.0}, 5.0);
  EXPECT_GT(vehicle.state().position.x(), 4.0);
  vehicle.reset({});
  EXPECT_EQ(vehicle.touched(), "");
}

// Whatever is commanded among boxes and balls at every angle: no surface ever inside the sphere,
// and the same commands give the same path.
TEST(VehicleInWorldLaw, NothingIsEnteredAndPathsRepeat) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    std::vector<TriangleMesh> meshes = {boxMesh("room", {8.0, 8.0, 8.0})};
    for (int i = 0; i < 25; ++i) {
      Eigen::Isometry3d pose(
          Eigen::Translation3d(4.0 * number(random), 4.0 * number(random), 4.0 * number(random)));
      pose.rotate(Eigen::Quaterniond(1.0 + number(random), number(random), number(random), 0.5)
                      .normalized());
      if (pose.translation().norm() > 1.5)
        meshes.push_back(i % 2 ? boxMesh("box", {0.8, 0.5, 1.2}).moved(pose)
                               : sphereMesh("ball", 0.5).moved(pose));
    }
    const auto world = std::make_shared<const World>(meshes);
    Vehicle first = vehicleIn(world, Vector3d::Zero());
    Vehicle second = vehicleIn(world, Vector3d::Zero());
    for (int i = 0; i < 3000; ++i) {
      if (i % 40 == 0) {
        const BodyVelocity command{2.0 * number(random), number(random), number(random),
                                   number(random)};
        first.command(command);
        second.command(command);
      }
      first.step();
      second.step();
      const auto surface = world->nearest(first.state().position, 0.3 - 2e-9);
      ASSERT_FALSE(surface) << surface->name << " at " << surface->distance << ", seed " << seed
                            << ", step " << i;
    }
    EXPECT_GT(first.contacts(), 0) << "the law was not tried, seed " << seed;
    EXPECT_TRUE(first.state().position == second.state().position);
    EXPECT_EQ(first.contacts(), second.contacts());
    EXPECT_EQ(first.touched(), second.touched());
  }
}

}  // namespace
}  // namespace grid_path_planner::simulation
