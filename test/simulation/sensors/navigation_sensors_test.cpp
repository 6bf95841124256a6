#include "simulation/sensors/navigation_sensors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "support/error_text.h"
#include "support/option_laws.h"
#include "support/rocking_drive.h"

namespace grid_path_planner::simulation {
namespace {

using test::contains, test::errorText;
using test::drive, test::rocking;

std::shared_ptr<const World> seabed() {
  return std::make_shared<const World>(std::vector<TriangleMesh>{
      planeMesh("seabed", Eigen::Vector3d::UnitZ(), {400.0, 400.0})
          .moved(Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -20.0)))});
}

NavigationSensorOptions allEnabled() {
  NavigationSensorOptions options;
  options.imu.enabled = options.dvl.enabled = true;
  options.pressure.enabled = options.usbl.enabled = options.laser.enabled = true;
  options.laser.mounting.pitch = 1.0;  // down at the seabed
  options.laser.range_max = 100.0;
  return options;
}

// What 20 s brought, in numbers.
std::vector<double> recorded(const NavigationSensorOptions& options) {
  NavigationSensors sensors(options, seabed());
  Vehicle vehicle(rocking());
  std::vector<double> numbers;
  const auto keep = [&](const Eigen::Vector3d& v) {
    numbers.insert(numbers.end(), v.begin(), v.end());
  };
  drive(vehicle, 20.0, 7, [&](const Vehicle& v) {
    const SensorReadings readings = sensors.advance(v.state(), v.timeNs());
    if (readings.imu) keep(readings.imu->angular_velocity), keep(readings.imu->specific_force);
    if (readings.dvl && readings.dvl->velocity) keep(readings.dvl->velocity->velocity);
    if (readings.pressure) numbers.push_back(readings.pressure->pressure);
    for (const UsblFix& fix : readings.usbl) keep(fix.position);
    if (readings.laser) numbers.push_back(readings.laser->ranges[180]);
  });
  return numbers;
}

TEST(NavigationSensorOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<NavigationSensorOptions>();
}

// The figures of doc/sensors.md: those of the IMU are uuv_simulator's.
TEST(NavigationSensorOptions, AreByDefaultThoseOfUsualUnderwaterSensors) {
  const ImuOptions imu;
  EXPECT_EQ(imu.rate, 100.0);
  const auto isTriad = [](const TriadErrors& triad, const std::array<double, 4>& expected) {
    return std::array<double, 4>{triad.noise, triad.walk, triad.correlation_time, triad.turn_on} ==
           expected;
  };
  EXPECT_TRUE(isTriad(imu.gyroscope, {3.394e-4, 3.879e-5, 1000.0, 0.0087}));
  EXPECT_TRUE(isTriad(imu.accelerometer, {0.004, 0.006, 300.0, 0.196}));
  EXPECT_EQ(imu.tilt_noise, 0.01);
  const DvlOptions dvl;
  EXPECT_EQ(dvl.rate, 7.0);
  EXPECT_NEAR(dvl.beam_angle, M_PI / 6.0, 1e-7);
  EXPECT_EQ(dvl.beam_noise, 0.005);
  EXPECT_EQ(dvl.range_min, 0.7);
  EXPECT_EQ(dvl.range_max, 90.0);
  const PressureOptions pressure;
  EXPECT_EQ(pressure.rate, 10.0);
  EXPECT_EQ(pressure.noise, 200.0);
  EXPECT_EQ(pressure.surface_z, 7.0);
  EXPECT_EQ(pressure.water_density, 1025.0);
  const UsblOptions usbl;
  EXPECT_EQ(usbl.rate, 1.0);
  EXPECT_EQ(usbl.range_noise, 0.1);
  EXPECT_NEAR(usbl.bearing_noise, M_PI / 180.0, 1e-7);
  EXPECT_EQ(usbl.delay, 0.6);
  EXPECT_EQ(usbl.outlier_share, 0.05);
  EXPECT_EQ(usbl.outlier_min, 2.0);
  EXPECT_EQ(usbl.outlier_max, 20.0);
}

TEST(NavigationSensorOptions, SenselessOnesAreRefusedByName) {
  const auto refusal = [](auto change) {
    NavigationSensorOptions options = allEnabled();
    change(options);
    return errorText([&] { checkNavigationSensorOptions(options, 0.01); });
  };
  EXPECT_EQ(refusal([](auto&) {}), "");
  EXPECT_TRUE(contains(refusal([](auto& o) { o.dvl.range_min = 91.0; }), "dvl_range_min"));
  EXPECT_TRUE(contains(refusal([](auto& o) { o.usbl.outlier_min = 21.0; }), "usbl_outlier_min"));
  EXPECT_TRUE(contains(refusal([](auto& o) { o.imu.rate = 101.0; }), "imu_rate must be at most"));
  EXPECT_TRUE(contains(refusal([](auto& o) { o.pressure.rate = 200.0; }), "pressure_rate"));
  EXPECT_TRUE(contains(refusal([](auto& o) { o.usbl.range_noise = -1.0; }), "usbl_range_noise"));
  EXPECT_EQ(refusal([](auto& o) { o.imu.enabled = false, o.imu.rate = 1000.0; }), "")
      << "a sensor that is off asks nothing of the time step";
}

TEST(NavigationSensors, ADvlOrALaserWithoutAWorldIsRefusedAndWhatWasStays) {
  const auto refuses = [](const auto& action) {
    return contains(errorText(action), "needs a world");
  };
  EXPECT_TRUE(refuses([] { NavigationSensors(allEnabled(), nullptr); }));
  NavigationSensorOptions with_laser;
  with_laser.laser.enabled = true;
  EXPECT_TRUE(refuses([&] { NavigationSensors(with_laser, nullptr); }));
  NavigationSensorOptions options;
  options.pressure.enabled = true;
  NavigationSensors sensors(options, nullptr);
  EXPECT_TRUE(refuses([&] { sensors.setOptions(allEnabled()); }));
  const SensorReadings readings = sensors.advance({}, 0);
  EXPECT_TRUE(readings.pressure);
  EXPECT_FALSE(readings.imu);
}

TEST(NavigationSensors, AreOffByDefault) {
  NavigationSensors sensors({}, seabed());
  Vehicle vehicle;
  drive(vehicle, 3.0, 8,
        [&](const Vehicle& v) { EXPECT_TRUE(sensors.advance(v.state(), v.timeNs()).empty()); });
}

TEST(NavigationSensors, TheSameSeedsGiveTheSameBits) {
  const auto first = recorded(allEnabled());
  EXPECT_EQ(first, recorded(allEnabled()));
  // 2000 IMU readings but the first, 140 of the DVL, 200 pressures, 19 fixes, 200 scans.
  EXPECT_NEAR(static_cast<double>(first.size()), 1999 * 6 + 140 * 3 + 200 + 19 * 3 + 200, 10.0);
}

TEST(NavigationSensors, ChangingOneLeavesTheOthersAsTheyAre) {
  NavigationSensors plain(allEnabled(), seabed()), changed(allEnabled(), seabed());
  Vehicle vehicle(rocking());
  drive(vehicle, 4.0, 9, [&](const Vehicle& v) {
    if (v.timeNs() == 2000000000) {
      NavigationSensorOptions options = allEnabled();
      options.dvl.seed = 5;
      options.usbl.enabled = false;
      changed.setOptions(options);
    }
    const auto a = plain.advance(v.state(), v.timeNs());
    const auto b = changed.advance(v.state(), v.timeNs());
    ASSERT_EQ(a.imu.has_value(), b.imu.has_value());
    if (a.imu) {
      EXPECT_EQ(a.imu->specific_force, b.imu->specific_force);
    }
    if (a.pressure) {
      EXPECT_EQ(a.pressure->pressure, b.pressure->pressure);
    }
    const bool after = v.timeNs() >= 2000000000;
    if (a.dvl && b.dvl) {
      EXPECT_EQ(a.dvl->velocity->velocity != b.dvl->velocity->velocity, after);
    }
    EXPECT_TRUE(!after || b.usbl.empty());
  });
}

}  // namespace
}  // namespace grid_path_planner::simulation
