// Sensors that are mounted, wired or configured wrongly: what the localizer says of its pose then (doc/localization.md
// has the table that `grid_path_planner_localization_faults` prints).
#include "localization/support/systematic_faults.h"

#include <gtest/gtest.h>

#include "support/error_text.h"

namespace grid_path_planner::localization {
namespace {

using test::contains;

constexpr double kSeconds = 100.0;
constexpr unsigned kSeeds = 3;

const SystematicFault kNone{"none", [](Measurement&, double, SimulatedSensors&) {}};

SystematicFault faultNamed(const std::string& name) {
  for (const SystematicFault& fault : systematicFaults())
    if (fault.name == name) return fault;
  throw std::out_of_range(name);
}

class LastingFault : public testing::TestWithParam<SystematicFault> {};

// OK was said for 6 s and DEGRADED for 117 of 120, while the pose was off by 22 m or by 180 degrees, and every fix
// contradicted it.
TEST_P(LastingFault, IsLostThreeSecondsAfterTheSecondContradiction) {
  for (const Suite suite : {Suite::USBL, Suite::MARKERS})
    for (unsigned seed = 1; seed <= kSeeds; ++seed) {
      const VerdictRun run = runWithFault(GetParam(), sensorsOf(suite, seed), kSeconds);
      EXPECT_LE(run.longest, 3.0) << "suite " << static_cast<int>(suite) << ", seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(All, LastingFault, testing::ValuesIn(systematicFaults()),
                         [](const auto& info) {
                           std::string name = info.param.name;
                           for (char& c : name) c = std::isalnum(c) ? c : '_';
                           return name;
                         });

// With acoustic fixes that are seldom, two in a row are all that there is for a while.
TEST(LastingFaults, AreLostWhereFixesAreSeldom) {
  for (const char* name : {"DVL turned by 90 deg", "compass off by 90 deg"})
    for (unsigned seed = 1; seed <= kSeeds; ++seed) {
      SimulatedSensors sensors = sensorsOf(Suite::USBL, seed);
      sensors.rates.usbl = 0.2;
      const VerdictRun run = runWithFault(faultNamed(name), sensors, kSeconds);
      EXPECT_FALSE(std::isnan(run.second)) << name;
      EXPECT_LE(run.longest, 3.0) << name << ", seed " << seed;
    }
}

// What begins anew by one cluster of fixes, and by the other the next time, was OK while off by 5 m for 8.9 s.
TEST(LastingFaults, ReflectionsAreContradictedByTheOtherHalf) {
  const VerdictRun run = runWithFault(faultNamed("USBL, half of the fixes 5 m off"),
                                      sensorsOf(Suite::USBL, 1), kSeconds);
  for (const VerdictSecond& second : run.seconds)
    if (second.t > faults::kBegins + 5.0)
      EXPECT_EQ(second.report.status, LocalizationStatus::LOST) << second.t;
  // The markers confirm the pose, and nothing is wrong with it.
  const VerdictRun with_markers = runWithFault(faultNamed("USBL, half of the fixes 5 m off"),
                                               sensorsOf(Suite::MARKERS, 1), kSeconds);
  EXPECT_TRUE(std::isnan(with_markers.lost));
  EXPECT_EQ(with_markers.off, 0.0);
}

// "Fixes that agree contradict the pose; the pose is known to 0.1 m" was said.
TEST(LastingFaults, NothingIsSaidToBeKnownBesideAContradiction) {
  int contradicted = 0;
  for (const SystematicFault& fault : systematicFaults())
    for (const VerdictSecond& second :
         runWithFault(fault, sensorsOf(Suite::USBL, 1), kSeconds).seconds) {
      const std::string& sentence = second.report.sentence;
      contradicted += contains(sentence, "contradicts");
      EXPECT_FALSE(contains(sentence, "contradicts") && contains(sentence, "known to")) << sentence;
    }
  EXPECT_GT(contradicted, 100);
}

// Two outliers in a row are none, nor is one in five.
TEST(SoundSensors, AreNeverLost) {
  for (const Suite suite : {Suite::USBL, Suite::MARKERS})
    for (const double outliers : {0.05, 0.2})
      for (unsigned seed = 1; seed <= 6; ++seed) {
        SimulatedSensors sensors = sensorsOf(suite, seed);
        sensors.usbl_outliers = outliers;
        const VerdictRun run = runWithFault(kNone, sensors, kSeconds);
        EXPECT_TRUE(std::isnan(run.lost)) << "seed " << seed << ", outliers " << outliers;
        EXPECT_EQ(run.seconds.back().report.status, LocalizationStatus::OK);
      }
}

// A vehicle that was carried away is LOST until the fixes have been right for a while, and then OK.
TEST(SoundSensors, AreBelievedAgainAfterTheyContradictedThePose) {
  const SystematicFault carried{"carried",
                                [](Measurement& measurement, double t, SimulatedSensors&) {
                                  auto* fix = std::get_if<PositionFix>(&measurement.data);
                                  if (fix && t > 20.0) fix->position.x() += 30.0;
                                }};
  const VerdictRun run = runWithFault(carried, sensorsOf(Suite::USBL, 1), 100.0);
  EXPECT_NEAR(run.lost, 23.0, 1.1);
  EXPECT_EQ(run.seconds.back().report.status, LocalizationStatus::OK);
}

// Each is named as what it is, before there is a pose and afterwards.
TEST(Gravity, ThatIsMeasuredWronglyIsNamed) {
  const std::pair<const char*, const char*> named[] = {
      {"accelerometer in g", "it is in g, and must be in m/s^2"},
      {"accelerometer without gravity", "its driver takes gravity off"},
      {"accelerometer of the wrong sign", "its sign is wrong"},
      {"IMU upside down", "upside down"}};
  for (const auto& [fault, words] : named)
    for (const Suite suite : {Suite::USBL, Suite::MARKERS})
      for (const VerdictSecond& second :
           runWithFault(faultNamed(fault), sensorsOf(suite, 1), 20.0).seconds)
        if (second.t > 0.6) {
          EXPECT_TRUE(contains(second.report.sentence, words)) << second.report.sentence;
          EXPECT_NE(second.report.status, LocalizationStatus::OK);
        }
}

// Of a vehicle that turns about by 0.5 rad, falls freely for a moment and is shaken.
TEST(Gravity, MayBeMissedForAMoment) {
  GravityCheck check;
  for (int i = 0; i < 1000; ++i) {
    ImuMeasurement imu;
    const double tilt = 0.5 * std::sin(0.02 * i);
    imu.attitude = faults::about(Eigen::Vector3d::UnitX(), tilt * 180.0 / M_PI);
    imu.inertial.acceleration = imu.attitude->conjugate() * Eigen::Vector3d(0.0, 0.0, 9.8);
    if (i % 200 > 180) imu.inertial.acceleration.setZero();
    imu.inertial.acceleration.x() += 4.0 * std::sin(0.3 * i);
    check.add(stampAt(0.01 * i), imu, Eigen::Quaterniond::Identity());
    EXPECT_EQ(check.sentence(9.80665), "") << i;
  }
}

}  // namespace
}  // namespace grid_path_planner::localization
