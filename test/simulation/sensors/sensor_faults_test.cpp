#include "simulation/sensors/sensor_faults.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "simulation/sensors/navigation_sensors.h"
#include "support/error_text.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::simulation {
namespace {

using Eigen::Vector3d;
using test::contains, test::errorText, test::TemporaryFolder;

std::vector<SensorFault> faultsOf(const std::string& text) {
  const TemporaryFolder folder;
  return readSensorFaults(folder.write("faults.yaml", text));
}

// The pressures that are left, by second: 10 s of a measurement a second.
std::vector<double> pressuresWith(const std::string& faults) {
  NavigationSensorOptions options;
  options.pressure.enabled = true;
  options.pressure.rate = 1.0;
  NavigationSensors sensors(options, nullptr, faultsOf(faults));
  std::vector<double> pressures;
  for (std::int64_t second = 0; second < 10; ++second) {
    const SensorReadings readings = sensors.advance({}, second * 1000000000);
    pressures.push_back(readings.pressure ? readings.pressure->pressure : 0.0);
    EXPECT_TRUE(!readings.pressure || readings.pressure->time_ns == second * 1000000000);
  }
  return pressures;
}

const char kNoFaults[] = "faults: []\n";

TEST(SensorFaults, AFileIsRead) {
  const auto faults = faultsOf(
      "faults:\n"
      "  - {sensor: dvl, from: 60, to: 90.5, kind: cut}\n"
      "  - {sensor: usbl, from: 0, to: 1, kind: offset, by: [5, 0, -0.5]}\n");
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].sensor, SensorName::DVL);
  EXPECT_EQ(faults[0].kind, FaultKind::CUT);
  EXPECT_TRUE(faults[0].holdsAt(60000000000));
  EXPECT_FALSE(faults[0].holdsAt(90500000000)) << "to is no part of it";
  EXPECT_EQ(faults[1].by, (std::vector<double>{5.0, 0.0, -0.5}));
}

TEST(SensorFaults, AMistakeIsToldWithFileAndLine) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"{sensor: sonar, from: 1, to: 2, kind: cut}",
       "sensor must be one of imu, dvl, pressure, usbl"},
      {"{sensor: imu, from: 1, to: 2, kind: broken}", "kind must be one of cut, frozen"},
      {"{sensor: imu, from: 2, to: 2, kind: cut}", "to must be above from"},
      {"{sensor: imu, from: -1, to: 2, kind: cut}", "from must be 0 to 1e9 s, got -1"},
      {"{sensor: imu, from: 1, to: .nan, kind: cut}", "to must be a number of seconds"},
      {"{sensor: imu, from: 1, kind: cut}", "has no 'to'"},
      {"{sensor: imu, from: 1, to: 2, kind: cut, until: 3}", "a fault has no 'until'"},
      {"{sensor: imu, from: 1, to: 2, kind: cut, by: [1]}", "a fault of kind cut has no 'by'"},
      {"{sensor: usbl, from: 1, to: 2, kind: offset}", "has no 'by'"},
      {"{sensor: usbl, from: 1, to: 2, kind: offset, by: [1, 2]}", "3 for usbl"},
      {"{sensor: imu, from: 1, to: 2, kind: outlier, by: 5}", "6 for imu, got '5'"},
      {"{sensor: usbl, from: 1, to: 2, kind: offset, by: [1, 2, .inf]}", "finite numbers"},
      {"{sensor: camera, from: 1, to: 2, kind: offset, by: [1]}",
       "a fault of the camera must be cut, frozen or nan (black), got offset"},
      {"{sensor: camera, from: 1, to: 2, kind: cut, by: [1]}", "a fault of kind cut has no 'by'"},
      {"cut", "a fault must be a mapping, got 'cut'"}};
  for (const auto& [entry, expected] : mistakes) {
    const std::string error =
        errorText([&, text = entry] { faultsOf(std::string("faults:\n  # one\n  - ") + text); });
    EXPECT_TRUE(contains(error, "faults.yaml:3: ")) << error;
    EXPECT_TRUE(contains(error, expected)) << error;
  }
  EXPECT_TRUE(contains(errorText([] { faultsOf("faults: 3\n"); }), "faults must be a list"));
  EXPECT_TRUE(contains(errorText([] { faultsOf("fault: []\n"); }), "has no 'fault'"));
  EXPECT_TRUE(contains(errorText([] { faultsOf("faults: [\n"); }), "is not YAML"));
  EXPECT_TRUE(contains(errorText([] { readSensorFaults("/no/faults.yaml"); }), "/no/faults.yaml"));
}

TEST(SensorFaults, EachKindSpoilsItsTimeAndNothingElse) {
  const auto sound = pressuresWith(kNoFaults);
  const auto spoiled = [&](const std::string& kind) {
    return pressuresWith("faults:\n  - {sensor: pressure, from: 3, to: 6, kind: " + kind + "}\n");
  };
  const auto cut = spoiled("cut"), frozen = spoiled("frozen"),
             offset = spoiled("offset, by: [500]"), outlier = spoiled("outlier, by: [1e5]"),
             none = spoiled("nan");
  for (std::size_t second = 0; second < sound.size(); ++second) {
    if (second < 3 || second >= 6) {
      for (const auto& other : {cut, frozen, offset, outlier, none})
        EXPECT_EQ(other[second], sound[second]) << second;
      continue;
    }
    EXPECT_EQ(cut[second], 0.0);
    EXPECT_EQ(frozen[second], sound[2]);
    EXPECT_EQ(offset[second], sound[second] + 500.0);
    EXPECT_GT(std::abs(outlier[second] - sound[second]), 100.0);
    EXPECT_TRUE(std::isnan(none[second]));
  }
  EXPECT_NE(outlier[4] - sound[4], outlier[5] - sound[5]) << "a new error each time";
}

TEST(SensorFaults, ASensorFrozenFromTheStartRepeatsItsFirstMeasurement) {
  const auto pressures =
      pressuresWith("faults:\n  - {sensor: pressure, from: 0, to: 5, kind: frozen}\n");
  EXPECT_EQ(pressures[4], pressures[0]);
  EXPECT_NE(pressures[5], pressures[0]);
}

TEST(SensorFaults, OfTwoAtOneTimeBothHappen) {
  const auto sound = pressuresWith(kNoFaults);
  const auto both = pressuresWith(
      "faults:\n  - {sensor: pressure, from: 0, to: 5, kind: offset, by: [1]}\n"
      "  - {sensor: pressure, from: 3, to: 4, kind: offset, by: [10]}\n");
  EXPECT_EQ(both[2], sound[2] + 1.0);
  EXPECT_EQ(both[3], sound[3] + 1.0 + 10.0);
}

//   s  0    1    2    3    4    5    6      of two at one time that which leaves less of an image
//      .....cut..........
//                ....frozen....
//           ...................nan....
TEST(SensorFaults, OfTheCameraSayWhatBefallsAnImage) {
  const auto faults = faultsOf(
      "faults:\n"
      "  - {sensor: camera, from: 1, to: 6, kind: nan}\n"
      "  - {sensor: camera, from: 2, to: 5, kind: frozen}\n"
      "  - {sensor: camera, from: 0.5, to: 3, kind: cut}\n"
      "  - {sensor: imu, from: 0, to: 9, kind: cut}\n");
  const auto at = [&](double t) { return cameraFaultAt(faults, std::llround(1e9 * t)); };
  EXPECT_FALSE(at(0.4));
  EXPECT_EQ(at(0.5), FaultKind::CUT);
  EXPECT_EQ(at(2.9), FaultKind::CUT);
  EXPECT_EQ(at(3.0), FaultKind::FROZEN);
  EXPECT_EQ(at(5.0), FaultKind::NOT_A_NUMBER);
  EXPECT_FALSE(at(6.0));
}

// A fix is spoiled for the time at which it was valid, not for that at which it arrives.
TEST(SensorFaults, OfOneSensorLeaveTheOthersAsTheyAre) {
  NavigationSensorOptions options;
  options.imu.enabled = options.usbl.enabled = true;
  NavigationSensors sound(options, nullptr);
  NavigationSensors faulty(options, nullptr,
                           faultsOf("faults:\n"
                                    "  - {sensor: usbl, from: 2, to: 3, kind: cut}\n"
                                    "  - {sensor: imu, from: 1, to: 2, kind: offset,"
                                    " by: [0, 0, 1, 0, 0, 0]}\n"));
  int missed = 0;
  for (std::int64_t step = 0; step < 500; ++step) {
    const auto right = sound.advance({}, step * 10000000);
    const auto wrong = faulty.advance({}, step * 10000000);
    ASSERT_EQ(right.imu.has_value(), wrong.imu.has_value());
    if (right.imu) {
      const bool held = step >= 100 && step < 200;
      EXPECT_EQ(wrong.imu->angular_velocity.z(),
                right.imu->angular_velocity.z() + (held ? 1.0 : 0.0));
      EXPECT_EQ(wrong.imu->specific_force, right.imu->specific_force);
    }
    if (right.usbl.size() == wrong.usbl.size()) continue;
    ++missed;
    EXPECT_EQ(right.usbl.at(0).time_ns, 2000000000);
  }
  EXPECT_EQ(missed, 1);
}

}  // namespace
}  // namespace grid_path_planner::simulation
