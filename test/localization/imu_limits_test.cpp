// One garbage sample of an IMU: within the limits of 100 rad/s it turned the heading by half a radian, OK.
#include <gtest/gtest.h>

#include "localization/support/simulated_sensors.h"
#include "localization/vehicle_localizer.h"
#include "support/error_text.h"

namespace grid_path_planner::localization {
namespace {

// Of an IMU of a vehicle that stands, after a change.
template <class Change>
std::string refusalAfter(const LocalizerOptions& options, const Change& change) {
  ImuMeasurement imu;
  imu.inertial.acceleration = {0.0, 0.0, options.filter.gravity};
  change(imu.inertial);
  VehicleLocalizer localizer(options);
  return test::errorText([&] { localizer.add({stampAt(0.0), Source::IMU, imu}); });
}

TEST(ImuLimits, ASampleBeyondWhatTheVehicleCanDoIsRefused) {
  const LocalizerOptions options;
  const auto refusal = [&](const auto& change) { return refusalAfter(options, change); };
  EXPECT_EQ(refusal([](Inertial&) {}), "");
  EXPECT_EQ(refusal([](Inertial& i) { i.rate.z() = 9.9; }), "");
  EXPECT_TRUE(test::contains(refusal([](Inertial& i) { i.rate.z() = 60.0; }),
                             "the angular velocity (rad/s) must be within 10, got 60"));
  EXPECT_TRUE(test::contains(refusal([](Inertial& i) { i.rate.x() = -10.1; }), "within 10"));
  EXPECT_TRUE(test::contains(refusal([](Inertial& i) { i.acceleration.y() = 500.0; }),
                             "the acceleration (m/s^2) must be within 100, got 500"));
}

TEST(ImuLimits, AreThoseOfTheOptions) {
  LocalizerOptions options;
  options.filter.imu_max_rate = 80.0;
  options.filter.imu_max_acceleration = 600.0;
  EXPECT_EQ(refusalAfter(options, [](Inertial& i) { i.rate.z() = 60.0; }), "");
  EXPECT_EQ(refusalAfter(options, [](Inertial& i) { i.acceleration.y() = 500.0; }), "");
}

}  // namespace
}  // namespace grid_path_planner::localization
