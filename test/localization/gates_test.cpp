// Which measurements are used: the gates, commands instead of a DVL, and what rejected fixes may begin anew.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "base/cholesky.h"
#include "localization/chi_squared.h"
#include "localization/lagged_filter.h"
#include "localization/support/simulated_sensors.h"

namespace grid_path_planner::localization {
namespace {

// What becomes of a measurement that comes to a filter which stands at the origin, each error of its pose known with a
// variance of 0.01.
Verdict verdictAtOrigin(Gate gate, Source source, const decltype(Measurement::data)& data) {
  FilterOptions options;
  options.gate = gate;
  LaggedFilter filter(options, Start::AT_FIX);
  filter.add({stampAt(0.0), Source::SET_POSE,
              PoseFix{Eigen::Vector3d::Zero(),
                      Eigen::Quaterniond::Identity(),
                      0.01 * PoseCovariance::Identity(),
                      {}}});
  return filter.add({stampAt(0.0) + 1, source, data});
}

PoseFix poseOff(double metres, double degrees, double variance = 1.0) {
  const Eigen::Vector3d turn(0.0, 0.0, degrees * M_PI / 180.0);
  return {
      {metres, 0.0, 0.0}, expSO3<double>(turn), variance * PoseCovariance::Identity(), Mounting()};
}

// As was published, "1 m and 12 degrees" with either reading; a variance of 1 lets chi squared pass all of these.
TEST(Gates, TheFixedOnesRejectByDistanceAndAngleAsTheirNamesSay) {
  const struct {
    double metres, degrees;
    bool either, both;  // rejected
  } cases[] = {{0.9, 11.0, false, false},
               {1.1, 11.0, true, false},
               {0.9, 13.0, true, false},
               {1.1, 13.0, true, true}};
  for (const auto& c : cases) {
    const auto isGated = [&](Gate gate) {
      return verdictAtOrigin(gate, Source::MARKER, poseOff(c.metres, c.degrees)) == Verdict::GATED;
    };
    EXPECT_EQ(isGated(Gate::EITHER), c.either) << c.metres << " m, " << c.degrees;
    EXPECT_EQ(isGated(Gate::BOTH), c.both) << c.metres << " m, " << c.degrees;
    EXPECT_FALSE(isGated(Gate::NONE));
    EXPECT_FALSE(isGated(Gate::CHI_SQUARED));
  }
  const PositionFix far{{50.0, 0.0, 0.0}, 0.01 * Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.0}};
  for (const Gate gate : {Gate::EITHER, Gate::BOTH, Gate::NONE})
    EXPECT_EQ(verdictAtOrigin(gate, Source::USBL, far), Verdict::TAKEN) << "of poses alone";
  EXPECT_EQ(verdictAtOrigin(Gate::CHI_SQUARED, Source::USBL, far), Verdict::GATED);
}

// Variances 0.01 of the pose and 0.03 of the fix: at 0.2 m times the root of 10.83, 16.27 and 22.46 there is the limit.
TEST(Gates, ChiSquaredRejectsWhatLiesBeyondTheTables) {
  for (const double share : {0.99, 1.01}) {
    const Verdict expected = share > 1.0 ? Verdict::GATED : Verdict::TAKEN;
    const auto off = [&](double limit) { return share * 0.2 * std::sqrt(limit); };
    const Eigen::Vector3d here(0.0, 0.0, 0.0);
    const auto verdict = [](Source source, const auto& data) {
      return verdictAtOrigin(Gate::CHI_SQUARED, source, data);
    };
    EXPECT_EQ(verdict(Source::DEPTH, DepthFix{off(10.83), 0.03, here}), expected);
    EXPECT_EQ(
        verdict(Source::USBL,
                PositionFix{{0.0, off(16.27), 0.0}, 0.03 * Eigen::Matrix3d::Identity(), here}),
        expected);
    EXPECT_EQ(verdict(Source::MARKER, poseOff(off(22.46), 0.0, 0.03)), expected);
  }
}

// Of one number, three and six. 20000 measurements: 20 are expected, with a standard deviation of 4.5.
TEST(Gates, RejectOneInAThousandGoodMeasurementsOfAnyDimension) {
  std::map<Source, SourceCounts> counts;
  for (unsigned seed = 100; seed < 110; ++seed) {
    SimulatedSensors sensors(seed);
    sensors.rates.depth = sensors.rates.dvl = sensors.rates.marker = 100.0;
    LaggedFilter filter(sensors.options, Start::AT_FIX);
    for (const Measurement& measurement : sensors.run(20.0)) filter.add(measurement);
    for (const Source source : {Source::DEPTH, Source::DVL, Source::MARKER}) {
      counts[source].taken += filter.counts(source).taken;
      counts[source].gated += filter.counts(source).gated;
    }
  }
  for (const auto& [source, count] : counts) {
    const auto gated = static_cast<double>(count.gated),
               all = gated + static_cast<double>(count.taken);
    EXPECT_GT(all, 19500.0);
    EXPECT_GT(gated / all, 0.0003) << nameOf(source);
    EXPECT_LT(gated / all, 0.0018) << nameOf(source);
  }
}

// An acoustic system that stands 30 m off agrees with itself for ever, and the panel's markers say otherwise.
TEST(Gates, FixesThatAgreeBeginNothingAnewWhileAnotherFixIsUsed) {
  SimulatedSensors sensors(21);
  sensors.rates.marker = 1.0;
  LaggedFilter filter(sensors.options, Start::AT_FIX);
  for (Measurement measurement : sensors.run(40.0)) {
    if (measurement.source == Source::USBL && measurement.stamp > stampAt(10.0))
      std::get<PositionFix>(measurement.data).position.x() += 30.0;
    filter.add(measurement);
  }
  EXPECT_GE(filter.counts(Source::USBL).gated, 28u);
  EXPECT_EQ(filter.counts(Source::USBL).resets, 0u);
  EXPECT_LT((filter.snapshot().estimate.state.position - sensors.truthAt(40.0).position).norm(),
            0.1);
}

// Once in command_period, from dvl_timeout after the last velocity of the DVL until the next.
TEST(Commands, AreUsedOnlyWhileTheDvlIsLost) {
  SimulatedSensors sensors(22);
  sensors.rates.command = 10.0;
  sensors.cut = [](Source source, double t) {
    return source == Source::DVL && t > 20.0 && t < 30.0;
  };
  LaggedFilter filter(sensors.options, Start::AT_FIX);
  std::set<double> used;
  for (const Measurement& measurement : sensors.run(40.0)) {
    const Verdict verdict = filter.add(measurement);
    const double t = secondsBetween(kStart, measurement.stamp);
    if (measurement.source == Source::COMMAND && t > 3.0 && verdict != Verdict::UNUSED)
      used.insert(t);
  }
  ASSERT_EQ(used.size(), 9u);
  EXPECT_NEAR(*used.begin(), 21.0, 0.11);
  EXPECT_NEAR(*used.rbegin(), 29.0, 0.11);
}

// A compass over the drive, whose headings pass from one end of +-pi to the other.
struct ByCompass {
  double radians = 0.0, nees = 0.0;
  std::uint64_t gated = 0;
};

ByCompass drivenByCompass(unsigned seed, double turn) {
  SimulatedSensors sensors(seed);
  sensors.trajectory.turn = turn;
  sensors.rates.usbl = 0.0;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> error(0.0, 0.02);
  LaggedFilter filter(sensors.options, Start::AT_FIX);
  const State start = sensors.truthAt(0.0);
  filter.add({stampAt(0.0), Source::SET_POSE,
              PoseFix{start.position, start.attitude, 1e-4 * PoseCovariance::Identity(), {}}});
  for (const Measurement& measurement : sensors.run(60.0)) {
    filter.add(measurement);
    if (measurement.source != Source::DEPTH) continue;
    const double t = secondsBetween(kStart, measurement.stamp);
    const double yaw =
        std::remainder(yawOf(sensors.truthAt(t).attitude) + error(random), 2.0 * M_PI);
    filter.add({measurement.stamp, Source::HEADING, HeadingFix{yaw, 0.02 * 0.02}});
  }
  const Estimate estimate = filter.snapshot().estimate;
  const State truth = sensors.truthAt(60.0);
  const ErrorVector off = errorBetween<double>(estimate.state, truth);
  return {
      std::abs(std::remainder(yawOf(estimate.state.attitude) - yawOf(truth.attitude), 2 * M_PI)),
      base::Cholesky<kErrors>(estimate.covariance).squaredMahalanobis(off),
      filter.counts(Source::HEADING).gated};
}

TEST(Heading, OfACompassIsUsedAcrossHalfATurnAsAnywhereElse) {
  const unsigned runs = 12;
  double nees = 0.0;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const ByCompass ahead = drivenByCompass(seed, 0.0), back = drivenByCompass(seed, M_PI);
    EXPECT_LT(ahead.radians, 0.02) << seed;
    EXPECT_NEAR(back.radians, ahead.radians, 1e-9) << seed;
    EXPECT_EQ(back.gated, ahead.gated);
    EXPECT_LE(ahead.gated, 4u) << "of 600";
    nees += back.nees / runs;
  }
  EXPECT_LT(nees, meanBounds(15, runs, 0.999).high);
  EXPECT_GT(nees, meanBounds(15, runs, 0.999).low);
}

}  // namespace
}  // namespace grid_path_planner::localization
