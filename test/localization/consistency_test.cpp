// Whether the errors of the filter are as large as it says, over seeded runs.
#include <gtest/gtest.h>

#include "base/cholesky.h"
#include "localization/chi_squared.h"
#include "localization/input_statistics.h"
#include "localization/lagged_filter.h"
#include "localization/support/simulated_sensors.h"

namespace grid_path_planner::localization {
namespace {

struct Errors {
  double nees = 0.0, pose_nees = 0.0;  // normalised estimation error squared
  double metres = 0.0, radians = 0.0;
};

Errors errorsOf(const Estimate& estimate, const State& truth) {
  const ErrorVector error = errorBetween<double>(estimate.state, truth);
  const MountedPose pose = poseOf(estimate);
  Eigen::Matrix<double, 6, 1> pose_error;
  pose_error << error.segment<3>(kPosition), error.segment<3>(kAttitude);
  return {base::Cholesky<kErrors>(estimate.covariance).squaredMahalanobis(error),
          base::Cholesky<6>(pose.covariance).squaredMahalanobis(pose_error),
          error.segment<3>(kPosition).norm(), error.segment<3>(kAttitude).norm()};
}

// Of the start, known well.
MountedPose exactPose(const SimulatedSensors& sensors) {
  const State truth = sensors.truthAt(0.0);
  return {truth.position, truth.attitude, 1e-6 * PoseCovariance::Identity()};
}

// A run, and the errors at its end.
Errors errorsAfter(SimulatedSensors& sensors, double seconds) {
  LaggedFilter filter(sensors.options, Start::AT_FIX);
  for (const Measurement& measurement : sensors.run(seconds)) filter.add(measurement);
  EXPECT_TRUE(filter.started());
  return errorsOf(filter.snapshot().estimate, sensors.truthAt(seconds));
}

using Setup = std::function<void(SimulatedSensors&)>;

Errors meanErrors(unsigned runs, double seconds, const Setup& setup) {
  Errors mean;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    SimulatedSensors sensors(seed);
    setup(sensors);
    const Errors errors = errorsAfter(sensors, seconds);
    mean.nees += errors.nees / runs;
    mean.pose_nees += errors.pose_nees / runs;
    mean.metres += errors.metres / runs;
    mean.radians += errors.radians / runs;
  }
  return mean;
}

TEST(Consistency, ErrorsAreAsLargeAsTheCovarianceSays) {
  const unsigned runs = 16;
  const Errors mean = meanErrors(runs, 40.0, [](SimulatedSensors&) {});
  const Interval all = meanBounds(15, runs, 0.999), pose = meanBounds(6, runs, 0.999);
  EXPECT_GT(mean.nees, all.low);
  EXPECT_LT(mean.nees, all.high);
  EXPECT_GT(mean.pose_nees, pose.low);
  EXPECT_LT(mean.pose_nees, pose.high);
  RecordProperty("anees", std::to_string(mean.nees));
  RecordProperty("pose_anees", std::to_string(mean.pose_nees));
  RecordProperty("metres", std::to_string(mean.metres));
}

// The angle by which the attitude is off after a minute on gyros without errors.
double turnMissed(bool measures_means, bool takes_means) {
  SimulatedSensors sensors(1);
  FilterOptions options = sensors.options;
  options.imu_averages = takes_means;
  sensors.takeErrorsFromImu();
  sensors.options.imu_averages = measures_means;
  sensors.rates.dvl = sensors.rates.usbl = sensors.rates.depth = 0.0;
  const MountedPose start = exactPose(sensors);
  LaggedFilter filter(options, Start::AT_FIX);
  filter.add({stampAt(0.0), Source::SET_POSE,
              PoseFix{start.position, start.attitude, start.covariance, {}}});
  for (const Measurement& measurement : sensors.run(60.0)) filter.add(measurement);
  return errorsOf(filter.snapshot().estimate, sensors.truthAt(60.0)).radians;
}

// The simulator's IMU measures means. Taken for the rate at its stamp, a turn at 0.8 rad/s came out 4 mrad short,
// which fixes corrected and the end of the turn brought back: 4 of 10 drives ended outside of their ellipse.
TEST(Consistency, SamplesOfTheImuAreMeansOrInstantsAsIsSaid) {
  for (const bool means : {true, false}) {
    EXPECT_LT(turnMissed(means, means), 2e-5) << means;
    EXPECT_GT(turnMissed(means, !means), 2e-4) << means;
  }
}

TEST(Consistency, AlsoWhereSamplesAreInstants) {
  const unsigned runs = 12;
  const Errors mean = meanErrors(
      runs, 30.0, [](SimulatedSensors& sensors) { sensors.options.imu_averages = false; });
  EXPECT_LT(mean.nees, meanBounds(15, runs, 0.999).high);
  EXPECT_GT(mean.nees, meanBounds(15, runs, 0.999).low);
}

// The first velocity of the DVL came to a filter that assumed none: about that, an error of the heading
// does not turn the velocity, and the filter believed the heading by far too much for a minute.
TEST(Consistency, AlsoRightAfterTheStart) {
  const unsigned runs = 24;
  const Errors mean = meanErrors(runs, 5.0, [](SimulatedSensors&) {});
  EXPECT_LT(mean.nees, meanBounds(15, runs, 0.999).high);
  EXPECT_LT(mean.pose_nees, meanBounds(6, runs, 0.999).high);
}

// Nothing tells the heading, and the velocity in the world turns with it. Each correction of the velocity
// passed for a measurement of the heading: after two minutes NEES was 61, after five 310, with a heading that was
// 19 degrees off and said to be known to 3.
TEST(Consistency, WhatNothingTellsStaysUnknown) {
  const unsigned runs = 16;
  const double seconds = 120.0;
  double mean = 0.0, radians = 0.0, said = 0.0;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    SimulatedSensors sensors(seed);
    sensors.rates.usbl = sensors.rates.depth = 0.0;
    const MountedPose start = exactPose(sensors);
    LaggedFilter filter(sensors.options, Start::AT_FIX);
    filter.add({stampAt(0.0), Source::SET_POSE,
                PoseFix{start.position, start.attitude, start.covariance, {}}});
    for (const Measurement& measurement : sensors.run(seconds)) filter.add(measurement);
    const Estimate estimate = filter.snapshot().estimate;
    const Errors errors = errorsOf(estimate, sensors.truthAt(seconds));
    mean += errors.nees / runs;
    radians += errors.radians / runs;
    said += std::sqrt(worldCovariance(poseOf(estimate))(5, 5)) / runs;
  }
  EXPECT_LT(mean, meanBounds(15, runs, 0.999).high);
  EXPECT_GT(mean, meanBounds(15, runs, 0.999).low);
  EXPECT_GT(radians, 0.1);  // it drifts
  EXPECT_GT(said, 0.1);
}

TEST(Consistency, AlsoWithPosesAndAfterAGapOfTheImu) {
  const unsigned runs = 12;
  const Errors mean = meanErrors(runs, 30.0, [](SimulatedSensors& sensors) {
    sensors.rates.marker = 5.0;
    sensors.rates.usbl = 0.0;
  });
  EXPECT_LT(mean.nees, meanBounds(15, runs, 0.999).high);
  EXPECT_GT(mean.nees, meanBounds(15, runs, 0.999).low);
  EXPECT_LT(mean.metres, 0.03);
  const Errors gap = meanErrors(runs, 30.0, [](SimulatedSensors& sensors) {
    sensors.rates.marker = 5.0;
    sensors.cut = [](Source source, double t) {
      return source == Source::IMU && t > 20.0 && t < 25.0;
    };
  });
  EXPECT_LT(gap.nees, meanBounds(15, runs, 0.999).high);
  EXPECT_LT(gap.metres, 0.04);
}

TEST(Consistency, OutliersAreGatedAndCostLittle) {
  const Errors clean = meanErrors(10, 40.0, [](SimulatedSensors&) {});
  const Errors outliers =
      meanErrors(10, 40.0, [](SimulatedSensors& sensors) { sensors.usbl_outliers = 0.3; });
  EXPECT_LT(outliers.metres, 1.5 * clean.metres);
  const Errors flipped = meanErrors(8, 30.0, [](SimulatedSensors& sensors) {
    sensors.rates.marker = 5.0;
    sensors.marker_flips = 0.1;
  });
  EXPECT_LT(flipped.metres, 0.03);
  EXPECT_LT(flipped.radians, 0.02);
}

TEST(Consistency, WithoutDvlCommandsBoundTheDrift) {
  const auto cut = [](Source source, double t) {
    return t > 20.0 && (source == Source::DVL || source == Source::USBL);
  };
  const Errors blind = meanErrors(6, 50.0, [&](SimulatedSensors& s) { s.cut = cut; });
  const Errors commanded = meanErrors(6, 50.0, [&](SimulatedSensors& sensors) {
    sensors.cut = cut;
    sensors.rates.command = 10.0;
  });
  EXPECT_LT(commanded.metres, 2.5);
  EXPECT_LT(commanded.metres, blind.metres);
  EXPECT_LT(commanded.nees, meanBounds(15, 6, 0.999).high);
  EXPECT_LT(blind.nees, meanBounds(15, 6, 0.999).high);
  const Errors fixes = meanErrors(6, 50.0, [](SimulatedSensors& sensors) {
    sensors.cut = [](Source source, double t) { return t > 20.0 && source == Source::DVL; };
  });
  EXPECT_LT(fixes.metres, 0.6);
}

TEST(Consistency, TheMeanNisOfTheDvlIsItsDimension) {
  double nis = 0.0, count = 0.0;
  for (unsigned seed = 100; seed < 110; ++seed) {
    SimulatedSensors sensors(seed);
    LaggedFilter filter(sensors.options, Start::AT_FIX);
    for (const Measurement& measurement : sensors.run(20.0)) filter.add(measurement);
    const InputStatistics dvl = inputStatistics(filter, Source::DVL, filter.newest());
    EXPECT_NEAR(dvl.rate, 7.0, 0.01);
    nis += dvl.nis_mean * dvl.nis_count;
    count += dvl.nis_count;
  }
  EXPECT_NEAR(nis / count, 3.0, 0.5);
}

// With them in the mean, one in twenty of an acoustic system made each of five seconds one in which its "errors are larger
// than its covariance says", which was said of a sound one (NIS 782 of 3).
TEST(Consistency, OutliersThatAreGatedDoNotCountAsErrorsOfTheOthers) {
  SimulatedSensors sensors(3);
  sensors.rates.usbl = 10.0;
  LaggedFilter filter(sensors.options, Start::AT_FIX);
  int number = 0, moved = 0;
  for (Measurement measurement : sensors.run(30.0)) {
    if (auto* fix = std::get_if<PositionFix>(&measurement.data);
        fix && measurement.stamp > stampAt(25.2) && ++number % 5 == 0) {
      fix->position.x() += 10.0 + number;
      ++moved;
    }
    filter.add(measurement);
  }
  const InputStatistics usbl = inputStatistics(filter, Source::USBL, filter.newest());
  EXPECT_GE(usbl.gated, moved);
  EXPECT_LE(usbl.gated, moved + 2);
  EXPECT_GT(usbl.nis_count, 4 * moved - 2);
  EXPECT_LT(usbl.nis_mean, meanBounds(3, usbl.nis_count, 0.999).high);
}

// A bag with a minute of nothing: of 13 such gaps three never ended. The filter went on from a tilt that nobody knew, and
// settled up to 180 degrees off, DEGRADED, so that the vehicle might be driven.
TEST(Consistency, AfterALongSilenceOfAllSensorsThePoseIsFoundAgain) {
  for (const double gap : {1.0, 2.0, 5.0, 20.0, 45.0, 300.0})
    for (unsigned seed = 1; seed <= 6; ++seed) {
      SimulatedSensors sensors(seed);
      sensors.cut = [&](Source source, double t) {
        const double late = source == Source::IMU ? 0.0 : 0.1 * seed;
        return t > 20.0 && t < 20.0 + gap + late;
      };
      for (const Start start : {Start::AT_FIX, Start::AT_ORIGIN}) {
        SimulatedSensors same = sensors;
        LaggedFilter filter(sensors.options, start);
        for (const Measurement& measurement : same.run(gap + 60.0)) {
          const bool is_fix = measurement.source == Source::USBL;
          if (start == Start::AT_FIX || !is_fix) filter.add(measurement);
        }
        ASSERT_TRUE(filter.started());
        const State state = filter.snapshot().estimate.state, truth = same.truthAt(gap + 60.0);
        const Eigen::Vector3d up = state.attitude.conjugate() * Eigen::Vector3d::UnitZ();
        const Eigen::Vector3d true_up = truth.attitude.conjugate() * Eigen::Vector3d::UnitZ();
        EXPECT_LT((up - true_up).norm(), 0.05) << gap << " s, seed " << seed;
        if (start == Start::AT_ORIGIN) continue;
        EXPECT_LT((state.position - truth.position).norm(), 0.5) << gap << " s, seed " << seed;
        EXPECT_LT(state.attitude.angularDistance(truth.attitude), 0.15)
            << gap << " s, seed " << seed;
      }
    }
}

}  // namespace
}  // namespace grid_path_planner::localization
