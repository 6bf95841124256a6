#include "simulation/sensors/laser_scanner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/option_laws.h"

namespace grid_path_planner::simulation {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

LaserOptions exactLaser() {
  LaserOptions options;
  options.noise = 0.0;
  return options;
}

std::vector<float> scanOf(const World& world, const LaserOptions& options, std::int64_t time_ns = 0,
                          const BodiesAt& bodies = {}) {
  return LaserScanner(world, options).measure({}, time_ns, bodies)->ranges;
}

// A wall across x at `distance` ahead of the origin.
World wallAcross(double distance) {
  return World({planeMesh("wall", Vector3d::UnitX(), {1000.0, 1000.0})
                    .moved(Isometry3d(Eigen::Translation3d(distance, 0.0, 0.0)))});
}

TEST(LaserOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<LaserOptions>();
}

// At once, and then each tenth of a second.
TEST(LaserScanner, MeasuresAtItsRate) {
  LaserScanner laser(World({}), exactLaser());
  int scans = 0;
  for (std::int64_t time = 10000000; time <= 1000000000; time += 10000000)
    scans += laser.measure({}, time).has_value();
  EXPECT_EQ(scans, 11);
}

// The distance along each ray is that of its angle; what is farther, aside or behind is infinite.
TEST(LaserScanner, MeasuresAWallAlongEachRay) {
  for (const double field : {1.0, 4.0, 6.28318}) {
    LaserOptions options = exactLaser();
    options.field_of_view = field;
    const World world = wallAcross(3.0);
    const std::vector<float> ranges = scanOf(world, options);
    ASSERT_EQ(ranges.size(), 360u);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double angle = angleMin(options) + i * angleIncrement(options);
      const double range = 3.0 / std::cos(angle);
      if (std::cos(angle) > 0.0 && range < 9.999) {
        EXPECT_NEAR(ranges[i], range, 1e-4) << angle;
      } else if (std::cos(angle) < 0.0 || range > 10.001) {
        EXPECT_TRUE(std::isinf(ranges[i])) << angle;
      }
    }
  }
}

// Where it is mounted turned to the left, a wall ahead of the vehicle is to its right.
TEST(LaserScanner, IsMountedOnTheVehicle) {
  LaserOptions options = exactLaser();
  options.mounting.x = 0.5;
  options.mounting.yaw = M_PI / 2;
  const std::vector<float> ranges = scanOf(wallAcross(3.0), options);
  EXPECT_NEAR(ranges[90], 2.5, 1e-4) << "-90 degrees";
  EXPECT_TRUE(std::isinf(ranges[270]));
}

TEST(LaserScanner, WritesNothingAsTheDriverDoes) {
  LaserOptions options = exactLaser();
  EXPECT_TRUE(std::isinf(scanOf(World({}), options)[0]));
  options.no_return = NoReturn::RANGE_MAX;
  EXPECT_EQ(scanOf(World({}), options)[0], 10.0f);
  options.range_min = 0.5;
  EXPECT_EQ(scanOf(wallAcross(0.4), options)[180], 0.0f) << "nearer than range_min";
}

TEST(LaserScanner, NoiseAndDropoutsHaveTheirSize) {
  LaserOptions options = exactLaser();
  options.rays = 10000;
  options.field_of_view = 0.01;
  options.noise = 0.02;
  options.dropout = 0.1;
  const World world = wallAcross(3.0);
  double sum = 0.0, squares = 0.0;
  int measured = 0;
  const std::vector<float> ranges = scanOf(world, options);
  for (const float range : ranges) {
    if (std::isinf(range)) continue;
    ++measured;
    sum += range - 3.0;
    squares += (range - 3.0) * (range - 3.0);
  }
  EXPECT_NEAR(measured, 9000, 150);
  EXPECT_NEAR(sum / measured, 0.0, 0.001);
  EXPECT_NEAR(std::sqrt(squares / measured), 0.02, 0.001);
  EXPECT_EQ(ranges, scanOf(world, options));
  EXPECT_NE(ranges, scanOf(world, options, 1));
  options.seed = 2;
  EXPECT_NE(ranges, scanOf(world, options));
}

TEST(LaserScanner, SeesWhoWalks) {
  const MovingBodies people({{"walker",
                              BodyShape::CYLINDER,
                              {0.3, 0.3, 0.9},
                              {{0.0, {2.0, -4.0, 0.9}}, {8.0, {2.0, 4.0, 0.9}}}}});
  LaserOptions options = exactLaser();
  options.mounting.z = 0.2;
  const auto ahead = [&](double time) {
    return scanOf(wallAcross(3.0), options, 0, people.at(time))[180];
  };
  EXPECT_NEAR(ahead(0.0), 3.0, 1e-4);
  EXPECT_NEAR(ahead(4.0), 1.7, 1e-4);
}

}  // namespace
}  // namespace grid_path_planner::simulation
