#include "grid_path_planner/simulation/dead_reckoning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/option_laws.h"

namespace grid_path_planner::simulation {
namespace {

VehicleState at(double x, double y, double z, double yaw) {
  return {Eigen::Vector3d(x, y, z), yaw, {0.5, 0.0, 0.0, 0.1}};
}

// Measured after each of `count` steps of 10 cm along x.
std::vector<VehicleState> drive(const DeadReckoningOptions& options, int count) {
  DeadReckoning odometry(options);
  odometry.reset(at(3.0, -2.0, 1.0, 0.3));
  std::vector<VehicleState> measured;
  for (int i = 1; i <= count; ++i) {
    odometry.advance(at(3.0 + 0.1 * i, -2.0, 1.0, 0.3));
    measured.push_back(odometry.measured());
  }
  return measured;
}

// Root of the mean square of the error in x at the end of `count` steps, over many seeds.
double deviation(DeadReckoningOptions options, int count) {
  double sum = 0.0;
  constexpr int kRuns = 400;
  for (int seed = 0; seed < kRuns; ++seed) {
    options.odometry_seed = seed;
    const double error = drive(options, count).back().position.x() - (3.0 + 0.1 * count);
    sum += error * error;
  }
  return std::sqrt(sum / kRuns);
}

TEST(DeadReckoningOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<DeadReckoningOptions>();
}

TEST(DeadReckoning, WithoutErrorsItIsTheTruthToTheLastBit) {
  DeadReckoning odometry;
  for (int i = 0; i < 1000; ++i) {
    const VehicleState truth = at(0.1 * i, std::sin(i), -1.0 / (i + 1), std::remainder(i, 6.283));
    odometry.advance(truth);
    const VehicleState measured = odometry.measured();
    ASSERT_EQ(measured.position, truth.position);
    ASSERT_EQ(measured.yaw, truth.yaw);
    ASSERT_EQ(measured.velocity.surge, truth.velocity.surge);
  }
}

TEST(DeadReckoning, DriftGrowsWithTheSquareRootOfTheDistance) {
  DeadReckoningOptions options;
  options.odometry_drift = 0.02;
  EXPECT_NEAR(deviation(options, 10), 0.02, 0.004);
  EXPECT_NEAR(deviation(options, 160), 0.08, 0.016);
}

TEST(DeadReckoning, NoiseIsTheSameHoweverFarItDrove) {
  DeadReckoningOptions options;
  options.odometry_noise = 0.05;
  EXPECT_NEAR(deviation(options, 1), 0.05, 0.01);
  EXPECT_NEAR(deviation(options, 160), 0.05, 0.01);
}

TEST(DeadReckoning, AnErrorOfTheYawBendsThePathThatFollows) {
  DeadReckoningOptions options;
  options.odometry_yaw_drift = 0.05;
  const std::vector<VehicleState> measured = drive(options, 200);
  for (std::size_t i = 1; i < measured.size(); ++i) {
    const Eigen::Vector3d step = measured[i].position - measured[i - 1].position;
    EXPECT_NEAR(step.norm(), 0.1, 1e-9);
    const double believed = measured[i - 1].yaw - 0.3;  // of the x axis, along which it drives
    EXPECT_NEAR(std::atan2(step.y(), step.x()), believed, 1e-6);
  }
  EXPECT_NE(measured.back().yaw, 0.3);
}

TEST(DeadReckoning, StandingStillDoesNotDriftAndAResetForgets) {
  DeadReckoningOptions options;
  options.odometry_drift = 0.1;
  DeadReckoning odometry(options);
  odometry.reset(at(1.0, 1.0, 1.0, 0.0));
  for (int i = 0; i < 100; ++i) odometry.advance(at(1.0, 1.0, 1.0, 0.0));
  EXPECT_EQ(odometry.measured().position, Eigen::Vector3d(1.0, 1.0, 1.0));
  odometry.advance(at(5.0, 1.0, 1.0, 0.0));
  EXPECT_NE(odometry.measured().position, Eigen::Vector3d(5.0, 1.0, 1.0));
  odometry.reset(at(7.0, 0.0, 0.0, 1.0));
  EXPECT_EQ(odometry.measured().position, Eigen::Vector3d(7.0, 0.0, 0.0));
}

TEST(DeadReckoning, TheSameSeedGivesTheSameRun) {
  DeadReckoningOptions options;
  options.odometry_drift = options.odometry_noise = options.odometry_yaw_drift = 0.01;
  const auto first = drive(options, 20);
  const auto second = drive(options, 20);
  options.odometry_seed = 2;
  const auto other = drive(options, 20);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].position, second[i].position);
    EXPECT_NE(first[i].position, other[i].position);
  }
}

}  // namespace
}  // namespace grid_path_planner::simulation
