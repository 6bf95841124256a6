#include "localization/vehicle_localizer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "grid_path_planner/base/errors.h"
#include "localization/measurement_check.h"
#include "localization/support/sensor_faults.h"
#include "localization/support/simulated_sensors.h"
#include "support/error_text.h"

namespace grid_path_planner::localization {
namespace {

using test::contains;
using test::errorText;

// The status at the end, and whether each was there.
struct Told {
  LocalizationReport last;
  bool ever[4] = {};
};

Told toldOf(SimulatedSensors& sensors, double seconds) {
  VehicleLocalizer localizer{LocalizerOptions{}};
  Told told;
  for (const Measurement& measurement : sensors.run(seconds)) {
    localizer.add(measurement);
    if (measurement.source != Source::IMU) continue;
    told.last = localizer.report(measurement.stamp);
    told.ever[static_cast<int>(told.last.status)] = true;
  }
  return told;
}

// By somebody who knows it.
Measurement poseSetAt(double t, const SimulatedSensors& sensors) {
  const State truth = sensors.truthAt(t);
  const MountedPose base =
      carried({truth.position, truth.attitude, PoseCovariance::Identity()}, sensors.base);
  return {stampAt(t), Source::SET_POSE,
          PoseFix{base.position, base.attitude, 0.01 * PoseCovariance::Identity(), sensors.base}};
}

TEST(Localizer, BeginsSaysOkAndIsWhereTheVehicleIs) {
  SimulatedSensors sensors(1);
  VehicleLocalizer localizer{LocalizerOptions{}};
  EXPECT_EQ(localizer.report(kStart).status, LocalizationStatus::INITIALIZING);
  EXPECT_TRUE(contains(localizer.report(kStart).sentence, "no IMU"));
  for (const Measurement& measurement : sensors.run(10.0)) localizer.add(measurement);
  EXPECT_EQ(localizer.report(stampAt(10.0)).status, LocalizationStatus::OK);
  const auto snapshot = localizer.mapAt(stampAt(10.0));
  ASSERT_TRUE(snapshot);
  EXPECT_LT((snapshot->estimate.state.position - sensors.truthAt(10.0).position).norm(), 0.3);
}

TEST(Localizer, IsDegradedWithoutDvlAndLostWithoutAnything) {
  SimulatedSensors dvl(2);
  dvl.cut = [](Source source, double t) { return source == Source::DVL && t > 10.0; };
  const Told degraded = toldOf(dvl, 20.0);
  EXPECT_EQ(degraded.last.status, LocalizationStatus::DEGRADED);
  EXPECT_TRUE(contains(degraded.last.sentence, "DVL lost 10 s ago")) << degraded.last.sentence;
  SimulatedSensors all(3);
  all.cut = [](Source source, double t) { return source != Source::IMU && t > 5.0; };
  const Told lost = toldOf(all, 60.0);
  EXPECT_EQ(lost.last.status, LocalizationStatus::LOST);
  EXPECT_TRUE(lost.ever[static_cast<int>(LocalizationStatus::OK)]);
}

// On IMU, DVL and depth alone nothing shows whether the sensors are as good as their covariances say, and the
// deviations stay small for minutes.
TEST(Localizer, IsDegradedAndThenLostWithoutFixes) {
  SimulatedSensors sensors(7);
  sensors.cut = [](Source source, double t) {
    return (source == Source::USBL || source == Source::MARKER) && t > 10.0;
  };
  VehicleLocalizer localizer{LocalizerOptions{}};
  LocalizerOptions trusting;
  trusting.fix_timeout = 0.0;
  VehicleLocalizer unbounded(trusting);
  for (const Measurement& measurement : sensors.run(80.0)) {
    localizer.add(measurement);
    unbounded.add(measurement);
  }
  const LocalizationReport lost = localizer.report(stampAt(80.0));
  EXPECT_EQ(lost.status, LocalizationStatus::LOST);
  EXPECT_TRUE(contains(lost.sentence, "lost 7")) << lost.sentence;  // USBL, once it was used
  EXPECT_NE(unbounded.report(stampAt(80.0)).status, LocalizationStatus::LOST)
      << "the deviations alone do not say so";
}

// An acoustic fix that is 5 m off for half a minute is gated, then believed: nobody can know which of the two was
// wrong. It was OK to say so; of 400 runs with faults 17 were off by metres and said OK.
TEST(Localizer, IsDegradedAfterWhatBeganThePoseAnew) {
  SimulatedSensors sensors(5);
  sensors.usbl_outliers = 0.0;
  VehicleLocalizer localizer{LocalizerOptions{}};
  LocalizerOptions trusting;
  trusting.reset_doubt = 0.0;
  VehicleLocalizer believing(trusting);
  bool believed = false;
  for (Measurement measurement : sensors.run(90.0)) {
    if (measurement.source == Source::USBL && measurement.stamp > stampAt(30.0))
      std::get<PositionFix>(measurement.data).position.x() += 5.0;
    localizer.add(measurement);
    believing.add(measurement);
    if (measurement.stamp < stampAt(50.0)) continue;
    EXPECT_NE(localizer.report(measurement.stamp).status, LocalizationStatus::OK);
    believed = believed || believing.report(measurement.stamp).status == LocalizationStatus::OK;
  }
  EXPECT_TRUE(believed);
  EXPECT_TRUE(
      contains(localizer.report(stampAt(90.0)).sentence, "USBL began anew what it measures"))
      << localizer.report(stampAt(90.0)).sentence;
  localizer.add(poseSetAt(90.0, sensors));
  EXPECT_FALSE(contains(localizer.report(stampAt(90.0)).sentence, "anew"));
}

// Of 400 seeds 17 said OK for more than 2 s while they were off by metres; these are some of them.
TEST(Localizer, DoesNotSayOkWhileItIsOff) {
  LocalizerOptions trusting;
  trusting.reset_doubt = 0.0;
  double ok = 0.0;
  int wrong = 0;
  for (const unsigned seed : {4u, 35u, 92u, 132u}) {
    const FaultRun run = runWithFaults(seed, 90.0);
    EXPECT_LT(run.longest, 2.0) << "seed " << seed;
    wrong += runWithFaults(seed, 90.0, trusting).longest >= 2.0 ? 1 : 0;
    ok += run.ok / 4.0;
  }
  EXPECT_GT(ok, 0.1) << "it says OK where it is right";
  EXPECT_EQ(wrong, 0) << "without reset_doubt, by the odds of what contradicted the pose";
}

// Measurements of an IMU whose heading has drifted.
std::vector<Measurement> driftedRun(SimulatedSensors& sensors, double seconds, double drift) {
  std::vector<Measurement> all = sensors.run(seconds);
  for (Measurement& measurement : all)
    if (measurement.source == Source::IMU) {
      auto& attitude = std::get<ImuMeasurement>(measurement.data).attitude;
      attitude = Eigen::AngleAxisd(drift, Eigen::Vector3d::UnitZ()) * *attitude;
    }
  return all;
}

// The heading of a plain IMU drifts. A localizer that was killed and began by it and acoustic fixes said OK, half a radian
// off, and the vehicle drove into what stood beside its path.
TEST(Localizer, OneThatStartsAgainBeginsWithTheHeadingThatWasKnown) {
  SimulatedSensors sensors(6);
  VehicleLocalizer before{LocalizerOptions{}};
  before.add(poseSetAt(0.0, sensors));
  for (const Measurement& measurement : driftedRun(sensors, 20.0, 0.5)) before.add(measurement);
  const auto known = before.headingAt(stampAt(20.0));
  ASSERT_TRUE(known);
  EXPECT_NEAR(known->offset, 0.5, 0.1);
  KnownHeading old = *known, of_later = *known;
  old.stamp -= 100'000'000'000;
  of_later.stamp += 100'000'000'000;

  VehicleLocalizer with{LocalizerOptions{}}, without = with, with_old = with, with_later = with;
  with.beginWith(*known);
  with_old.beginWith(old);
  with_later.beginWith(of_later);
  for (const Measurement& measurement : driftedRun(sensors, 5.0, 0.5))
    for (VehicleLocalizer* localizer : {&with, &without, &with_old, &with_later})
      if (measurement.stamp > stampAt(22.0)) localizer->add(measurement);
  const auto yawError = [&](const VehicleLocalizer& localizer, double t) {
    const double yaw = yawOf(localizer.mapAt(stampAt(t))->estimate.state.attitude);
    return std::abs(std::remainder(yaw - yawOf(sensors.truthAt(t).attitude), 2.0 * M_PI));
  };
  EXPECT_LT(yawError(with, 25.0), 0.1);
  EXPECT_EQ(with.report(stampAt(25.0)).status, LocalizationStatus::OK);
  for (const VehicleLocalizer* localizer : {&without, &with_later})
    EXPECT_GT(yawError(*localizer, 25.0), 0.3) << "it begins by the IMU alone";
  // After a minute it was the IMU's alone, and OK: known from long ago is not known, which is LOST.
  EXPECT_LT(yawError(with_old, 24.5), 0.15);
  EXPECT_EQ(with_old.report(stampAt(24.5)).status, LocalizationStatus::LOST);
}

// A marker was all that told the pose: no other sentence tells that it is gone.
TEST(Localizer, MarkersThatAreGoneAreMissed) {
  SimulatedSensors sensors(8);
  sensors.rates.marker = 1.0;
  sensors.cut = [](Source source, double t) {
    return source == Source::USBL || (source == Source::MARKER && t > 10.0);
  };
  VehicleLocalizer localizer{LocalizerOptions{}};
  std::map<LocalizationStatus, double> first;  // s
  for (const Measurement& measurement : sensors.run(80.0)) {
    localizer.add(measurement);
    if (measurement.stamp > stampAt(10.0))
      first.emplace(localizer.report(measurement.stamp).status,
                    secondsBetween(stampAt(0.0), measurement.stamp));
  }
  ASSERT_EQ(first.count(LocalizationStatus::DEGRADED), 1u);
  ASSERT_EQ(first.count(LocalizationStatus::LOST), 1u);
  EXPECT_NEAR(first[LocalizationStatus::DEGRADED], 30.0, 1.5);
  EXPECT_NEAR(first[LocalizationStatus::LOST], 70.0, 1.5);
  EXPECT_TRUE(contains(localizer.report(stampAt(80.0)).sentence, "no fix has been used for"));
  localizer.add(poseSetAt(80.0, sensors));
  EXPECT_NE(localizer.report(stampAt(80.0)).status, LocalizationStatus::LOST);
}

// Whatever fixes say, outliers too: the odometry is to the bit what it is without them. A DVL corrects it by
// some centimetres, as it finds out the heading and the biases.
TEST(Localizer, TheOdometryNeverJumps) {
  SimulatedSensors sensors(4);
  sensors.usbl_outliers = 0.3;
  sensors.rates.marker = 1.0;
  sensors.marker_flips = 0.3;
  VehicleLocalizer localizer{LocalizerOptions{}}, without_fixes{LocalizerOptions{}};
  std::optional<State> before;
  double largest = 0.0;
  for (const Measurement& measurement : sensors.run(40.0)) {
    localizer.add(measurement);
    if (measurement.source == Source::USBL || measurement.source == Source::MARKER) continue;
    without_fixes.add(measurement);
    const auto now = localizer.odometryAt(measurement.stamp);
    ASSERT_TRUE(now);
    EXPECT_EQ(now->estimate.state.position,
              without_fixes.odometryAt(measurement.stamp)->estimate.state.position);
    if (before)
      largest = std::max(largest, (now->estimate.state.position - before->position).norm());
    before = now->estimate.state;
  }
  EXPECT_LT(largest, 0.1);  // 0.01 of it is the motion
  EXPECT_GT(largest, 0.001);
}

// Somebody carries the vehicle, or the filter went astray: without a return nothing would ever be
// used again.
TEST(Localizer, FixesThatAgreeBringAFilterBackThatWentAstray) {
  SimulatedSensors sensors(5);
  VehicleLocalizer localizer{LocalizerOptions{}};
  const std::vector<Measurement> all = sensors.run(30.0);
  bool reset = false, doubted = false;
  for (const Measurement& measurement : all) {
    Measurement moved = measurement;
    if (moved.source == Source::USBL && moved.stamp > stampAt(15.0))
      std::get<PositionFix>(moved.data).position += Eigen::Vector3d(30.0, 0.0, 0.0);
    reset |= localizer.add(moved) == Verdict::RESET;
    doubted |= !reset && localizer.report(moved.stamp).status == LocalizationStatus::DEGRADED;
  }
  EXPECT_TRUE(reset);
  EXPECT_TRUE(doubted);
  const Eigen::Vector3d expected = sensors.truthAt(30.0).position + Eigen::Vector3d(30.0, 0.0, 0.0);
  EXPECT_LT((localizer.mapAt(stampAt(30.0))->estimate.state.position - expected).norm(), 0.5);
}

TEST(Localizer, OneOutlierAtTheStartIsNotBelieved) {
  SimulatedSensors sensors(6);
  VehicleLocalizer localizer{LocalizerOptions{}};
  for (Measurement measurement : sensors.run(5.0)) {
    if (measurement.source == Source::USBL && measurement.stamp == stampAt(1.0))
      std::get<PositionFix>(measurement.data).position.x() += 15.0;
    localizer.add(measurement);
  }
  ASSERT_TRUE(localizer.mapAt(stampAt(5.0)));
  EXPECT_LT((localizer.mapAt(stampAt(5.0))->estimate.state.position - sensors.truthAt(5.0).position)
                .norm(),
            0.5);
}

TEST(Localizer, APoseThatIsSetIsTaken) {
  SimulatedSensors sensors(7);
  VehicleLocalizer localizer{LocalizerOptions{}};
  for (const Measurement& measurement : sensors.run(1.0))
    if (measurement.source != Source::USBL) localizer.add(measurement);
  EXPECT_FALSE(localizer.mapAt(stampAt(1.0)));
  localizer.add(poseSetAt(1.0, sensors));
  const State truth = sensors.truthAt(1.0);
  ASSERT_TRUE(localizer.mapAt(stampAt(1.0)));
  EXPECT_LT((localizer.mapAt(stampAt(1.0))->estimate.state.position - truth.position).norm(), 0.1);
}

// A measurement that is refused, and the sentence that says why.
struct BadInput {
  const char* name;
  std::function<void(Measurement&)> spoil;
  Source source;
  const char* sentence;
};

class RefusedInput : public testing::TestWithParam<BadInput> {};

TEST_P(RefusedInput, ChangesNothingAndSaysWhy) {
  SimulatedSensors sensors(8);
  sensors.rates.marker = 2.0;
  VehicleLocalizer localizer{LocalizerOptions{}};
  std::vector<Measurement> all = sensors.run(8.0);
  for (const Measurement& measurement : all) localizer.add(measurement);
  Measurement bad = *std::find_if(all.rbegin(), all.rend(), [](const Measurement& measurement) {
    return measurement.source == GetParam().source;
  });
  bad.stamp += 1;
  GetParam().spoil(bad);
  const Estimate before = localizer.mapAt(stampAt(8.0))->estimate;
  const std::string sentence = errorText([&] { localizer.add(bad); });
  EXPECT_TRUE(contains(sentence, GetParam().sentence)) << sentence;
  const Estimate after = localizer.mapAt(stampAt(8.0))->estimate;
  EXPECT_EQ(before.covariance, after.covariance);
  EXPECT_EQ(before.state.position, after.state.position);
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

DvlVelocity& dvlOf(Measurement& m) {
  return std::get<DvlVelocity>(m.data);
}
PoseFix& poseOf(Measurement& m) {
  return std::get<PoseFix>(m.data);
}
ImuMeasurement& imuOf(Measurement& m) {
  return std::get<ImuMeasurement>(m.data);
}

const BadInput kBadInputs[] = {
    {"Nan", [](Measurement& m) { dvlOf(m).velocity.x() = kNan; }, Source::DVL, "velocity"},
    {"Infinite", [](Measurement& m) { imuOf(m).inertial.rate.y() = kInfinity; }, Source::IMU,
     "angular velocity"},
    {"Huge", [](Measurement& m) { poseOf(m).position.z() = 1e308; }, Source::MARKER, "position"},
    {"NegativeVariance", [](Measurement& m) { dvlOf(m).covariance(1, 1) = -1.0; }, Source::DVL,
     "negative means no measurement"},
    {"ZeroCovariance", [](Measurement& m) { dvlOf(m).covariance.setZero(); }, Source::DVL,
     "no sensor is exact"},
    {"NanCovariance", [](Measurement& m) { poseOf(m).covariance(0, 1) = kNan; }, Source::MARKER,
     "not finite"},
    {"HugeVariance", [](Measurement& m) { poseOf(m).covariance(2, 2) = 1e300; }, Source::MARKER,
     "within 1e-12..1e12"},
    {"Indefinite",
     [](Measurement& m) {
       dvlOf(m).covariance.setConstant(1.0);
       dvlOf(m).covariance(0, 1) = dvlOf(m).covariance(1, 0) = 2.0;
     },
     Source::DVL, "positive definite"},
    {"Quaternion", [](Measurement& m) { poseOf(m).attitude.coeffs() *= 2.0; }, Source::MARKER,
     "length of the orientation"},
    {"SensorFarAway", [](Measurement& m) { dvlOf(m).sensor.position.x() = 1e200; }, Source::DVL,
     "place on the vehicle"},
    {"PoseOfSomethingFarAway", [](Measurement& m) { poseOf(m).mounting.position.y() = kNan; },
     Source::MARKER, "place on the vehicle"},
    {"Twice", [](Measurement& m) { m.stamp -= 1; }, Source::DVL, "same stamp"},
    {"TooOld", [](Measurement& m) { m.stamp = stampAt(1.0) + 1; }, Source::DVL, "history"}};

INSTANTIATE_TEST_SUITE_P(All, RefusedInput, testing::ValuesIn(kBadInputs),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Stamps, OfTheFutureAndOfLongAgoAreRefused) {
  EXPECT_NO_THROW(checkStamp(stampAt(1.05), stampAt(1.0), 5.0));
  EXPECT_TRUE(contains(errorText([] { checkStamp(stampAt(1.2), stampAt(1.0), 5.0); }), "future"));
  EXPECT_TRUE(contains(errorText([] { checkStamp(stampAt(1.0), stampAt(7.0), 5.0); }), "history"));
  // "USBL refused: it is 1795457560.6 s old", said of a bag that was played without use_sim_time.
  for (const auto& [stamp, now] : {std::pair(32.0, 1.8e9), std::pair(1.8e9, 32.0)})
    EXPECT_TRUE(
        contains(errorText([s = stamp, n = now] { checkStamp(stampAt(s), stampAt(n), 5.0); }),
                 "use_sim_time"));
  EXPECT_FALSE(
      contains(errorText([] { checkStamp(stampAt(1.0), stampAt(7.0), 5.0); }), "use_sim_time"));
}

TEST(Localizer, OptionsOutsideTheirLimitsAreRefusedByName) {
  LocalizerOptions options;
  options.filter.history = -1.0;
  EXPECT_TRUE(contains(errorText([&] { VehicleLocalizer localizer(options); }), "history"));
}

// An IMU that is missed for a minute, and a DVL for as long: nothing explodes, and nothing says OK that
// is not.
TEST(Localizer, MissedSensorsNeverMakeTheStateExplode) {
  SimulatedSensors sensors(9);
  sensors.cut = [](Source source, double t) {
    return t > 5.0 && t < 65.0 && (source == Source::IMU || source == Source::DVL);
  };
  VehicleLocalizer localizer{LocalizerOptions{}};
  for (const Measurement& measurement : sensors.run(80.0)) {
    localizer.add(measurement);
    const auto snapshot = localizer.mapAt(measurement.stamp);
    if (!snapshot) continue;
    ASSERT_TRUE(snapshot->estimate.covariance.allFinite());
    const double t = secondsBetween(kStart, measurement.stamp);
    const double error =
        (snapshot->estimate.state.position - sensors.trajectory.stateAt(t).position).norm();
    ASSERT_LT(error, 10.0) << t;
    if (error > 1.0) {
      ASSERT_NE(localizer.report(measurement.stamp).status, LocalizationStatus::OK) << t;
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::localization
