#include <gtest/gtest.h>

#include <random>

#include "localization/chi_squared.h"
#include "localization/coasting.h"
#include "localization/filter_start.h"
#include "localization/imu_propagation.h"
#include "localization/mounted_pose.h"

namespace grid_path_planner::localization {
namespace {

constexpr double kGravity = 9.80665;

TEST(KnownAnswers, FreeFall) {
  State state;
  for (int i = 0; i < 200; ++i) state = propagated<double>(state, {}, 0.01, kGravity);
  EXPECT_NEAR(state.position.z(), -0.5 * kGravity * 4.0, 1e-9);
  EXPECT_NEAR(state.velocity.z(), -2.0 * kGravity, 1e-9);
}

TEST(KnownAnswers, AnImuAtRestStaysWhereItIs) {
  State state;
  for (int i = 0; i < 1000; ++i)
    state =
        propagated<double>(state, {Eigen::Vector3d::Zero(), {0.0, 0.0, kGravity}}, 0.01, kGravity);
  EXPECT_LT(errorBetween<double>(State(), state).norm(), 1e-9);
}

// 1 m/s at 0.5 rad/s: a circle of 2 m, once around.
TEST(KnownAnswers, ACircleAtConstantRateCloses) {
  State state;
  state.velocity = {1.0, 0.0, 0.0};
  const int steps = 1000;
  const double seconds = 4.0 * M_PI / steps;
  double highest = 0.0;
  for (int i = 0; i < steps; ++i) {
    state = propagated<double>(state, {{0.0, 0.0, 0.5}, {0.0, 0.5, kGravity}}, seconds, kGravity);
    highest = std::max(highest, state.position.y());
  }
  EXPECT_NEAR(highest, 4.0, 1e-3);
  EXPECT_LT(state.position.norm(), 1e-3);
  EXPECT_LT((state.velocity - Eigen::Vector3d::UnitX()).norm(), 1e-9);
}

TEST(KnownAnswers, ConstantVelocityWithoutAnImu) {
  Estimate estimate;
  estimate.state.velocity = {0.5, -0.25, 0.125};
  estimate.covariance.diagonal().segment<3>(kVelocity).setConstant(0.04);
  coast(estimate, 10.0, {0.3, 0.1, 0.0, 0.0});
  EXPECT_LT((estimate.state.position - Eigen::Vector3d(5.0, -2.5, 1.25)).norm(), 1e-12);
  // 0.04 t^2 + 0.3^2 t^3 / 3, 0.1^2 t
  EXPECT_NEAR(estimate.covariance(kPosition, kPosition), 4.0 + 30.0, 1e-9);
  EXPECT_NEAR(estimate.covariance(kAttitude, kAttitude), 0.1, 1e-12);
}

TEST(KnownAnswers, GatesAreThoseOfTheTables) {
  EXPECT_NEAR(chiSquaredQuantile(1, 0.999), 10.83, 0.005);
  EXPECT_NEAR(chiSquaredQuantile(3, 0.999), 16.27, 0.005);
  EXPECT_NEAR(chiSquaredQuantile(6, 0.999), 22.46, 0.005);
  EXPECT_NEAR(meanBounds(3, 10, 0.95).low, 1.679, 0.001);
  EXPECT_NEAR(meanBounds(3, 10, 0.95).high, 4.698, 0.001);
}

TEST(KnownAnswers, ALevelImuWithoutOrientationStartsLevelAndHeadsAlongX) {
  FilterOptions options;
  ImuMeasurement imu;
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.6, 0.8, 0.0)));
  imu.inertial.acceleration = tilt.conjugate() * Eigen::Vector3d(0.0, 0.0, kGravity);
  const MountedPose pose = poseAtOrigin(imu, options);
  const Eigen::Vector3d up = pose.attitude * imu.inertial.acceleration.normalized();
  EXPECT_LT((up - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_NEAR(yawOf(pose.attitude), 0.0, 1e-12);
}

// Errors of a pose that is carried to another place are those errors, carried.
TEST(KnownAnswers, CovariancesAreCarriedWithThePose) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  const auto vector = [&](double size) {
    const double x = normal(random), y = normal(random), z = normal(random);
    return Eigen::Vector3d(size * Eigen::Vector3d(x, y, z));
  };
  const Mounting mounting{vector(1.0), expSO3<double>(vector(1.0))};
  const MountedPose pose{vector(5.0), expSO3<double>(vector(1.0)),
                         1e-6 * PoseCovariance::Identity()};
  const MountedPose there = carried(pose, mounting);
  PoseCovariance sampled = PoseCovariance::Zero();
  const int samples = 20000;
  for (int i = 0; i < samples; ++i) {
    const MountedPose moved{pose.position + vector(1e-3),
                            pose.attitude * expSO3<double>(vector(1e-3)), pose.covariance};
    const MountedPose wrong = carried(moved, mounting);
    Eigen::Matrix<double, 6, 1> error;
    error << wrong.position - there.position,
        logSO3<double>(there.attitude.conjugate() * wrong.attitude);
    sampled += error * error.transpose() / samples;
  }
  EXPECT_LT((sampled - there.covariance).norm(), 0.05 * there.covariance.norm());
  const MountedPose back = carried(there, inverse(mounting));
  EXPECT_LT((back.covariance - pose.covariance).norm(), 1e-18);
  EXPECT_LT((ownCovariance(worldCovariance(there), there.attitude) - there.covariance).norm(),
            1e-18);
}

}  // namespace
}  // namespace grid_path_planner::localization
