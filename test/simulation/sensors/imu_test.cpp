#include "simulation/sensors/imu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/option_laws.h"
#include "support/rocking_drive.h"

namespace grid_path_planner::simulation {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Matrix3d, Eigen::Quaterniond, Eigen::Vector3d;
using test::drive, test::rocking, test::varianceOf;

ImuOptions exactImu() {
  ImuOptions options;
  options.gyroscope = options.accelerometer = {0.0, 0.0, 100.0, 0.0};
  options.tilt_noise = 0.0;
  return options;
}

// What stands on the sea floor for `count` measurements measures.
std::vector<ImuReading> atRest(const ImuOptions& options, int count,
                               const VehicleState& state = {}) {
  Imu imu(options);
  const std::int64_t period_ns = std::llround(1e9 / options.rate);
  std::vector<ImuReading> readings;
  for (std::int64_t i = 0; i <= count; ++i)
    if (const auto reading = imu.measure(state, i * period_ns)) readings.push_back(*reading);
  return readings;
}

double angleBetween(const Quaterniond& a, const Matrix3d& b) {
  return std::abs(AngleAxisd(a.toRotationMatrix().transpose() * b).angle());
}

TEST(ImuOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<ImuOptions>();
}

// REP 145: what an accelerometer that lies still reads points up.
TEST(Imu, AtRestItReadsGravityUpwards) {
  const auto readings = atRest(exactImu(), 5);
  ASSERT_EQ(readings.size(), 5u) << "none of the first sample, which has no mean";
  EXPECT_EQ(readings[0].specific_force, Vector3d(0.0, 0.0, 9.80665));
  EXPECT_EQ(readings[0].angular_velocity, Vector3d(0.0, 0.0, 0.0));
  EXPECT_EQ(readings[0].time_ns, 10000000);
}

TEST(Imu, ATiltTurnsWhatItReadsOfGravity) {
  VehicleState state;
  state.yaw = 1.0;
  state.roll = 0.2;
  const auto readings = atRest(exactImu(), 1, state);
  const Vector3d expected = 9.80665 * Vector3d(0.0, std::sin(0.2), std::cos(0.2));
  EXPECT_NEAR((readings[0].specific_force - expected).norm(), 0.0, 1e-12);
}

TEST(Imu, AUnitThatIsMountedUpsideDownReadsGravityDownwards) {
  ImuOptions options = exactImu();
  options.mounting.roll = M_PI;
  const auto readings = atRest(options, 1);
  EXPECT_NEAR((readings[0].specific_force - Vector3d(0.0, 0.0, -9.80665)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(
      angleBetween(readings[0].orientation, AngleAxisd(M_PI, Vector3d::UnitX()).toRotationMatrix()),
      0.0, 1e-9);
}

// At 0.5 m/s and 0.4 rad/s: v * w = 0.2 m/s^2 to the left, and w^2 * r outwards at a lever arm.
TEST(Imu, OnACircleAtConstantRateItReadsTheCentripetalAcceleration) {
  for (const double lever_arm : {0.0, 0.8}) {
    ImuOptions options = exactImu();
    options.mounting.x = lever_arm;
    Imu imu(options);
    Vehicle vehicle;
    std::optional<ImuReading> last;
    for (int i = 0; i < 400; ++i) {
      vehicle.command({0.5, 0.0, 0.0, 0.4});
      vehicle.step();
      if (const auto reading = imu.measure(vehicle.state(), vehicle.timeNs())) last = reading;
    }
    ASSERT_TRUE(last);
    const Vector3d expected(-0.4 * 0.4 * lever_arm, 0.5 * 0.4, 9.80665);
    EXPECT_NEAR((last->specific_force - expected).norm(), 0.0, 1e-5);
    EXPECT_NEAR((last->angular_velocity - Vector3d(0.0, 0.0, 0.4)).norm(), 0.0, 1e-9);
  }
}

// The law that ties all of it together: attitude, velocity and position of the unit, integrated from
// measurements without noise, are those of a vehicle that drives, turns, rolls and pitches for a minute.
TEST(Imu, WithoutNoiseItsIntegralIsTheDrive) {
  ImuOptions options = exactImu();
  options.mounting = {0.3, -0.1, 0.2, 0.1, -0.2, 2.0};
  Imu imu(options);
  Vehicle vehicle(rocking());
  imu.measure(vehicle.state(), 0);
  const auto poseOf = [&] { return mapFromBase(vehicle.state()) * options.mounting.pose(); };
  const auto velocityOf = [&] {
    const BodyTwist twist = bodyTwist(vehicle.state());
    return Vector3d(mapFromBase(vehicle.state()).linear() *
                    (twist.linear + twist.angular.cross(options.mounting.pose().translation())));
  };
  Isometry3d pose = poseOf();
  Vector3d velocity = velocityOf();
  drive(vehicle, 60.0, 4, [&](const Vehicle& v) {
    const auto reading = imu.measure(v.state(), v.timeNs());
    ASSERT_TRUE(reading);
    const double angle = 0.01 * reading->angular_velocity.norm();
    const Vector3d axis = reading->angular_velocity.normalized();
    const Matrix3d halfway = pose.linear() * AngleAxisd(0.5 * angle, axis);
    const Vector3d before = velocity;
    velocity += 0.01 * (halfway * reading->specific_force - Vector3d(0.0, 0.0, 9.80665));
    pose.translation() += 0.005 * (before + velocity);
    pose.linear() = pose.linear() * AngleAxisd(angle, axis);
    ASSERT_NEAR(angleBetween(reading->orientation, poseOf().linear()), 0.0, 1e-7);
  });
  EXPECT_NEAR((pose.linear() - poseOf().linear()).norm(), 0.0, 1e-9);
  EXPECT_NEAR((velocity - velocityOf()).norm(), 0.0, 1e-9);
  EXPECT_NEAR((pose.translation() - poseOf().translation()).norm(), 0.0, 5e-3);
  EXPECT_GT(vehicle.state().position.norm(), 1.0);
}

TEST(Imu, BeingPutElsewhereIsNoMotion) {
  Imu imu(exactImu());
  VehicleState state;
  imu.measure(state, 0);
  ASSERT_TRUE(imu.measure(state, 10000000));
  state.position.x() = 100.0;
  state.velocity.surge = 1.5;
  imu.jump();
  EXPECT_FALSE(imu.measure(state, 20000000));
  const auto reading = imu.measure(state, 30000000);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->specific_force, Vector3d(0.0, 0.0, 9.80665));
}

// uuv_simulator's variance is the same at every rate, which makes the unit better the slower it is read.
TEST(Imu, WhiteNoiseHasItsDensityAtEveryRateAndItsVarianceSaysSo) {
  for (const double rate : {20.0, 100.0}) {
    ImuOptions options = exactImu();
    options.rate = rate;
    options.gyroscope.noise = 3.394e-4;
    options.accelerometer.noise = 0.004;
    std::vector<double> turns, forces;
    const auto readings = atRest(options, 20000);
    for (const ImuReading& reading : readings) {
      turns.push_back(reading.angular_velocity.x());
      forces.push_back(reading.specific_force.y());
    }
    const ImuReading& last = readings.back();
    EXPECT_DOUBLE_EQ(last.angular_velocity_variance, 3.394e-4 * 3.394e-4 * rate);
    EXPECT_DOUBLE_EQ(last.specific_force_variance, 0.004 * 0.004 * rate);
    // 20000 samples: the standard deviation of their variance is 1 %.
    EXPECT_NEAR(varianceOf(turns) / last.angular_velocity_variance, 1.0, 0.04);
    EXPECT_NEAR(varianceOf(forces) / last.specific_force_variance, 1.0, 0.04);
  }
}

// Allan's variance of white noise falls with the time it is averaged over.
TEST(Imu, MeansOfWhiteNoiseFallAsAllanHasIt) {
  ImuOptions options = exactImu();
  options.gyroscope.noise = 1e-3;
  const auto readings = atRest(options, 40000);
  for (const std::size_t averaged : {10u, 100u}) {
    double sum = 0.0, before = 0.0;
    const std::size_t count = readings.size() / averaged;
    for (std::size_t i = 0; i < count; ++i) {
      double mean = 0.0;
      for (std::size_t j = 0; j < averaged; ++j)
        mean += readings[i * averaged + j].angular_velocity.z() / static_cast<double>(averaged);
      if (i > 0) sum += 0.5 * (mean - before) * (mean - before);
      before = mean;
    }
    const double expected = 1e-6 / (0.01 * static_cast<double>(averaged));
    EXPECT_NEAR(sum / static_cast<double>(count - 1) / expected, 1.0,
                5.0 / std::sqrt(static_cast<double>(count)));
  }
}

// Over seeds, the drifting bias has the variance of a Gauss-Markov process that began at 0:
// walk^2 tau / 2 (1 - exp(-2 t / tau)).
TEST(Imu, TheBiasDriftsAsAGaussMarkovProcess) {
  ImuOptions options = exactImu();
  options.rate = 10.0;
  options.accelerometer = {0.0, 0.006, 5.0, 0.0};
  std::vector<double> after_two, after_twenty;
  for (options.seed = 0; options.seed < 700; ++options.seed) {
    const auto readings = atRest(options, 200);
    for (int axis = 0; axis < 2; ++axis) {
      after_two.push_back(readings[19].specific_force[axis]);
      after_twenty.push_back(readings[199].specific_force[axis]);
    }
  }
  const auto expected = [](double t) {
    return 0.006 * 0.006 * 2.5 * (1.0 - std::exp(-2.0 * t / 5.0));
  };
  // 1400 samples: 3.8 % of standard deviation.
  EXPECT_NEAR(varianceOf(after_two) / expected(2.0), 1.0, 0.15);
  EXPECT_NEAR(varianceOf(after_twenty) / expected(20.0), 1.0, 0.15);
}

TEST(Imu, TheTurnOnBiasIsOneForARunAndAnotherForAnotherSeed) {
  ImuOptions options = exactImu();
  options.gyroscope.turn_on = 0.0087;
  std::vector<double> biases;
  for (options.seed = 0; options.seed < 500; ++options.seed) {
    const auto readings = atRest(options, 3);
    ASSERT_EQ(readings[0].angular_velocity, readings[2].angular_velocity);
    for (const double bias : readings[0].angular_velocity) biases.push_back(bias);
  }
  EXPECT_NEAR(std::sqrt(varianceOf(biases)) / 0.0087, 1.0, 0.08);
}

// The covariance of the heading is the one that it errs with, over seeds, however long it drifts.
TEST(Imu, TheHeadingDriftsWithTheGyroscopesAndItsVarianceSaysHowFar) {
  ImuOptions options;
  options.gyroscope = {2e-3, 1e-3, 8.0, 0.003};
  options.rate = 10.0;
  options.tilt_noise = 0.0;
  std::vector<double> early, late;
  for (options.seed = 0; options.seed < 600; ++options.seed) {
    const auto readings = atRest(options, 200);
    const auto error = [](const ImuReading& reading) {
      const Vector3d ahead = reading.orientation * Vector3d::UnitX();
      return std::atan2(ahead.y(), ahead.x()) / std::sqrt(reading.heading_variance);
    };
    early.push_back(error(readings[9]));
    late.push_back(error(readings[199]));
  }
  EXPECT_NEAR(varianceOf(early), 1.0, 0.25);
  EXPECT_NEAR(varianceOf(late), 1.0, 0.25);
}

TEST(Imu, TiltErrsByWhatItsVarianceSaysAndAHeadingErrorByWhatNothingSays) {
  ImuOptions options = exactImu();
  options.tilt_noise = 0.01;
  options.heading_error = 0.14;
  std::vector<double> tilts;
  for (const ImuReading& reading : atRest(options, 5000)) {
    const Vector3d up = reading.orientation * Vector3d::UnitZ();
    tilts.push_back(std::asin(up.x()));
    const Vector3d ahead = reading.orientation * Vector3d::UnitX();
    EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), 0.14, 1e-3);
    EXPECT_EQ(reading.heading_variance, 0.0);
  }
  EXPECT_NEAR(varianceOf(tilts) / 1e-4, 1.0, 0.1);
}

TEST(Imu, TheSameSeedGivesTheSameBitsAndAnotherOneOthers) {
  ImuOptions options;
  const auto first = atRest(options, 50), again = atRest(options, 50);
  options.seed = 2;
  const auto other = atRest(options, 50);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].specific_force, again[i].specific_force);
    EXPECT_EQ(first[i].angular_velocity, again[i].angular_velocity);
    EXPECT_EQ(first[i].orientation.coeffs(), again[i].orientation.coeffs());
    EXPECT_NE(first[i].specific_force, other[i].specific_force);
  }
}

}  // namespace
}  // namespace grid_path_planner::simulation
