// Whatever the order of arrival, and wherever the world's origin and north are.
#include "localization/lagged_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "base/cholesky.h"
#include "localization/support/simulated_sensors.h"

namespace grid_path_planner::localization {
namespace {

LaggedFilter filtered(const std::vector<Measurement>& measurements, const FilterOptions& options) {
  LaggedFilter filter(options, Start::AT_FIX);
  for (const Measurement& measurement : measurements) filter.add(measurement);
  return filter;
}

void expectSameBits(const Estimate& a, const Estimate& b) {
  const auto same = [](const auto& x, const auto& y) {
    return std::memcmp(x.data(), y.data(), sizeof(double) * static_cast<std::size_t>(x.size())) ==
           0;
  };
  EXPECT_TRUE(same(a.state.position, b.state.position));
  EXPECT_TRUE(same(a.state.velocity, b.state.velocity));
  EXPECT_TRUE(same(a.state.attitude.coeffs(), b.state.attitude.coeffs()));
  EXPECT_TRUE(same(a.state.gyro_bias, b.state.gyro_bias));
  EXPECT_TRUE(same(a.state.accelerometer_bias, b.state.accelerometer_bias));
  EXPECT_TRUE(same(a.covariance, b.covariance));
}

std::vector<Measurement> everything(unsigned seed, double seconds) {
  SimulatedSensors sensors(seed);
  sensors.rates.marker = 5.0;
  sensors.rates.command = 10.0;
  sensors.usbl_outliers = 0.3;
  sensors.cut = [](Source source, double t) {
    return (source == Source::IMU && t > 2.0 && t < 2.5) || (source == Source::DVL && t > 1.0);
  };
  return sensors.run(seconds);
}

TEST(OrderOfArrival, AnyOrderGivesTheSameBits) {
  const FilterOptions options;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::vector<Measurement> measurements = everything(seed, 4.0);
    const LaggedFilter in_order = filtered(measurements, options);
    ASSERT_TRUE(in_order.started());
    std::shuffle(measurements.begin(), measurements.end(), std::mt19937_64(seed));
    const LaggedFilter shuffled = filtered(measurements, options);
    expectSameBits(in_order.snapshot().estimate, shuffled.snapshot().estimate);
  }
}

// Each source with a delay of its own, over much longer than the history.
TEST(OrderOfArrival, LateSourcesGiveTheSameBits) {
  const FilterOptions options;
  std::vector<Measurement> measurements = everything(7, 20.0);
  const LaggedFilter in_order = filtered(measurements, options);
  const auto arrival = [](const Measurement& measurement) {
    const double delay = measurement.source == Source::USBL     ? 4.9
                         : measurement.source == Source::MARKER ? 0.3
                         : measurement.source == Source::IMU    ? 0.05
                                                                : 0.0;
    return secondsBetween(kStart, measurement.stamp) + delay;
  };
  std::stable_sort(
      measurements.begin(), measurements.end(),
      [&](const Measurement& a, const Measurement& b) { return arrival(a) < arrival(b); });
  const LaggedFilter late = filtered(measurements, options);
  expectSameBits(in_order.snapshot().estimate, late.snapshot().estimate);
  EXPECT_EQ(in_order.counts(Source::USBL).taken, late.counts(Source::USBL).taken);
  EXPECT_EQ(in_order.counts(Source::USBL).gated, late.counts(Source::USBL).gated);
  EXPECT_GT(late.counts(Source::USBL).gated, 0u);
}

TEST(OrderOfArrival, ASecondOfTheSameStampIsADuplicate) {
  std::vector<Measurement> measurements = everything(1, 1.0);
  LaggedFilter filter = filtered(measurements, {});
  const FilterSnapshot before = filter.snapshot();
  for (const Measurement& measurement : measurements)
    EXPECT_EQ(filter.add(measurement), Verdict::DUPLICATE);
  expectSameBits(before.estimate, filter.snapshot().estimate);
}

TEST(OrderOfArrival, WhatIsOlderThanTheHistoryIsRefusedAndTheMemoryIsBounded) {
  const std::vector<Measurement> measurements = everything(2, 30.0);
  LaggedFilter filter = filtered(measurements, {});
  Measurement old = measurements[measurements.size() / 2];
  old.stamp += 1;
  const std::size_t kept = filter.events().size();
  EXPECT_EQ(filter.add(old), Verdict::TOO_OLD);
  EXPECT_EQ(filter.events().size(), kept);
  EXPECT_LT(kept, 5.2 * 130.0);
}

// An IMU of 100 kHz: the history of 5 s took gigabytes.
TEST(OrderOfArrival, TheMemoryIsBoundedHoweverManyComeInTheHistory) {
  LaggedFilter filter({}, Start::AT_ORIGIN);
  ImuMeasurement imu;
  imu.inertial.acceleration = {0.0, 0.0, 9.80665};
  const int number = 100'000;
  for (int i = 0; i < number; ++i) {
    ASSERT_EQ(filter.add({kStart + 10'000 * i, Source::IMU, imu}), Verdict::TAKEN);
    ASSERT_LE(filter.events().size(), kMostEvents);
  }
  EXPECT_EQ(filter.counts(Source::IMU).taken, static_cast<std::uint64_t>(number));
  EXPECT_EQ(filter.add({kStart + 5, Source::IMU, imu}), Verdict::TOO_OLD);
  EXPECT_LT(filter.snapshot().estimate.state.position.norm(), 1e-6);
}

TEST(OrderOfArrival, AfterAResetNothingIsKept) {
  LaggedFilter filter = filtered(everything(3, 8.0), {});
  filter.reset();
  EXPECT_FALSE(filter.started());
  for (const Measurement& measurement : everything(3, 8.0)) filter.add(measurement);
  expectSameBits(filter.snapshot().estimate, filtered(everything(3, 8.0), {}).snapshot().estimate);
}

// A fix stamped 80 ms ahead came, and what was published of now was the pose of then.
TEST(OrderOfArrival, AnEarlierTimeIsAskedForAsBeforeALaterMeasurementCame) {
  const std::vector<Measurement> measurements = everything(4, 8.0);
  LaggedFilter filter = filtered(measurements, {});
  const Stamp now = filter.newest();
  const Estimate before = filter.snapshotAt(now).estimate;
  ASSERT_GT(before.state.velocity.norm(), 0.1);
  filter.add({now + 80'000'000, Source::DEPTH, DepthFix{-19.5, 0.01, {0.0, 0.0, 0.0}}});
  expectSameBits(before, filter.snapshotAt(now).estimate);
  EXPECT_EQ(filter.snapshotAt(now).stamp, now);
  EXPECT_GT((filter.snapshot().estimate.state.position - before.state.position).norm(), 0.001);
}

// Between two measurements of the IMU it is where it passes, too.
TEST(OrderOfArrival, BetweenTwoMeasurementsItIsMovedOn) {
  SimulatedSensors sensors(5);
  const LaggedFilter filter = filtered(sensors.run(10.0), {});
  const auto errorAt = [&](double t) {
    return Eigen::Vector3d(filter.snapshotAt(stampAt(t)).estimate.state.position -
                           sensors.truthAt(t).position);
  };
  EXPECT_LT((errorAt(9.0051) - errorAt(9.0001)).norm(), 5e-4)
      << "the vehicle moves by ten times that";
  EXPECT_EQ(filter.snapshotAt(stampAt(9.0051)).stamp, stampAt(9.0051));
}

// The same run in a world that is shifted and turned: the estimate is shifted and turned, whatever
// its heading, over +-pi too.
TEST(Invariance, UnderAShiftAndATurnOfTheWorld) {
  for (const double turn : {0.3, 0.5 * M_PI, M_PI, -3.0}) {
    SimulatedSensors here(11), there(11);
    here.rates.marker = there.rates.marker = 2.0;
    here.rates.usbl = there.rates.usbl = 0.0;  // its noise is along the axes of the world
    there.trajectory.turn = turn;
    there.trajectory.shift = {100.0, -50.0, -10.0};
    // Noise of marker poses is drawn along the axes of the world too: it is turned along.
    std::vector<Measurement> first = here.run(20.0), second = there.run(20.0);
    const Eigen::Quaterniond q = there.trajectory.worldTurn();
    for (std::size_t i = 0; i < first.size(); ++i)
      if (first[i].source == Source::MARKER) {
        auto& fix = std::get<PoseFix>(second[i].data);
        const auto& original = std::get<PoseFix>(first[i].data);
        fix.position = q * (original.position - here.trajectory.shift) + there.trajectory.shift;
        fix.attitude = q * original.attitude;
      }
    const Estimate a = filtered(first, here.options).snapshot().estimate;
    const Estimate b = filtered(second, there.options).snapshot().estimate;
    EXPECT_LT(
        (q * (a.state.position - here.trajectory.shift) + there.trajectory.shift - b.state.position)
            .norm(),
        1e-9);
    EXPECT_LT(logSO3<double>((q * a.state.attitude).conjugate() * b.state.attitude).norm(), 1e-9);
    EXPECT_LT((q * a.state.velocity - b.state.velocity).norm(), 1e-9);
    EXPECT_NEAR(a.covariance.trace(), b.covariance.trace(), 1e-9);
  }
}

// Without an IMU and with nothing but positions the filter is linear: constant velocity with white
// noise. Its last state is the weighted least-squares solution over the whole run.
TEST(LinearCase, TheFilterIsTheBatchLeastSquares) {
  FilterOptions options;
  options.gate = Gate::NONE;
  LaggedFilter filter(options, Start::AT_FIX);
  PoseFix start{
      Eigen::Vector3d::Zero(), Eigen::Quaterniond::Identity(), PoseCovariance::Identity(), {}};
  filter.add({stampAt(0.0), Source::SET_POSE, start});
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const int fixes = 30;
  const double period = 0.1, variance = 0.04;
  // Unknowns: position and velocity of x at each fix; rows weighted by the root of their information.
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2 + 3 * fixes, 2 * (fixes + 1));
  Eigen::VectorXd values = Eigen::VectorXd::Zero(rows.rows());
  rows(0, 0) = 1.0;
  rows(1, 1) = 1.0 / options.start_velocity;
  const double q = options.coast_acceleration * options.coast_acceleration;
  // whiten^T whiten is the inverse of the process noise, q (T^3 / 3, T^2 / 2; T^2 / 2, T).
  Eigen::Matrix2d whiten;
  whiten << std::sqrt(12.0 / (q * std::pow(period, 3))), -std::sqrt(3.0 / (q * period)), 0.0,
      std::sqrt(1.0 / (q * period));
  Eigen::Matrix2d motion;
  motion << 1.0, period, 0.0, 1.0;
  for (int i = 1; i <= fixes; ++i) {
    const double x = 0.3 * i * period + 0.2 * normal(random);
    filter.add({stampAt(i * period), Source::USBL,
                PositionFix{{x, 0.0, 0.0}, variance * Eigen::Matrix3d::Identity(), {0, 0, 0}}});
    const int row = 2 + 3 * (i - 1);
    rows.block<2, 2>(row, 2 * (i - 1)) = -whiten * motion;
    rows.block<2, 2>(row, 2 * i) = whiten;
    rows(row + 2, 2 * i) = 1.0 / std::sqrt(variance);
    values(row + 2) = x / std::sqrt(variance);
  }
  const Eigen::MatrixXd information = rows.transpose().lazyProduct(rows);
  const base::Cholesky<Eigen::Dynamic> factor(information);
  const Eigen::VectorXd solution = factor.solved(rows.transpose().lazyProduct(values));
  const Eigen::MatrixXd covariance = factor.inverse();
  const Estimate estimate = filter.snapshot().estimate;
  EXPECT_NEAR(estimate.state.position.x(), solution[2 * fixes], 1e-9);
  EXPECT_NEAR(estimate.state.velocity.x(), solution[2 * fixes + 1], 1e-9);
  EXPECT_NEAR(estimate.covariance(kPosition, kPosition), covariance(2 * fixes, 2 * fixes), 1e-9);
  EXPECT_NEAR(estimate.covariance(kVelocity, kVelocity), covariance(2 * fixes + 1, 2 * fixes + 1),
              1e-9);
}

TEST(NoInformation, TheCovarianceOnlyGrows) {
  SimulatedSensors sensors(4);
  sensors.rates.dvl = sensors.rates.depth = 0.0;
  sensors.cut = [](Source source, double t) {
    return (source == Source::USBL && t > 1.5) || (source == Source::IMU && t > 5.0 && t < 7.0);
  };
  LaggedFilter filter(sensors.options, Start::AT_FIX);
  ErrorVector before = ErrorVector::Zero();
  for (const Measurement& measurement : sensors.run(10.0)) {
    filter.add(measurement);
    if (secondsBetween(stampAt(1.5), measurement.stamp) < 0.0) continue;
    const ErrorVector now = filter.snapshot().estimate.covariance.diagonal();
    for (int block = 0; block < kErrors; block += 3)
      EXPECT_GE(now.segment<3>(block).sum(), before.segment<3>(block).sum() * (1.0 - 1e-9))
          << block;
    before = now;
  }
}

}  // namespace
}  // namespace grid_path_planner::localization
