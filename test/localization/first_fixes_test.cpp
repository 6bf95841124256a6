// With which fixes a filter begins.
#include <gtest/gtest.h>

#include "localization/support/simulated_sensors.h"
#include "localization/vehicle_localizer.h"

namespace grid_path_planner::localization {
namespace {

// A vehicle that stands.
void stand(Trajectory& trajectory) {
  for (Wave* wave : {&trajectory.x, &trajectory.y, &trajectory.z, &trajectory.roll,
                     &trajectory.pitch, &trajectory.yaw})
    wave->amplitude = 0.0;
}

// The attitude of an IMU that had been silent for a minute and a half was that of the vehicle, to a degree.
TEST(FirstFixes, OfAPositionNeedAnAttitudeOfTheSameTime) {
  for (const double age : {0.05, 100.0}) {
    SimulatedSensors sensors(31);
    stand(sensors.trajectory);
    LaggedFilter filter(sensors.options, Start::AT_FIX);
    for (Measurement measurement : sensors.run(1.0)) {
      if (measurement.source == Source::USBL) {
        measurement.stamp += stampAt(age) - kStart;
        filter.add(measurement);
      } else if (measurement.source == Source::IMU) {
        filter.add(measurement);
      }
    }
    EXPECT_EQ(filter.started(), age < 1.0) << age;
  }
}

// The farther apart two fixes were, the more was allowed between them, without an end.
TEST(FirstFixes, SeldomOnesDoNotConfirmAnOutlier) {
  SimulatedSensors sensors(32);
  sensors.rates.usbl = 0.1;
  VehicleLocalizer localizer{LocalizerOptions{}};
  for (const Measurement& measurement : sensors.run(9.0)) localizer.add(measurement);
  for (Measurement measurement : sensors.run(36.0)) {
    if (measurement.source == Source::USBL && measurement.stamp == stampAt(10.0))
      std::get<PositionFix>(measurement.data).position.x() += 15.0;
    localizer.add(measurement);
    const auto snapshot = localizer.mapAt(measurement.stamp);
    if (!snapshot) continue;
    const double t = secondsBetween(kStart, measurement.stamp);
    ASSERT_LT((snapshot->estimate.state.position - sensors.truthAt(t).position).norm(), 2.0) << t;
  }
}

TEST(FirstFixes, SeldomOnesOfAVehicleThatStandsAreEnough) {
  SimulatedSensors sensors(33);
  stand(sensors.trajectory);
  sensors.rates.usbl = 0.1;
  VehicleLocalizer localizer{LocalizerOptions{}};
  for (const Measurement& measurement : sensors.run(12.0)) localizer.add(measurement);
  const auto snapshot = localizer.mapAt(stampAt(12.0));
  ASSERT_TRUE(snapshot);
  EXPECT_LT((snapshot->estimate.state.position - sensors.truthAt(12.0).position).norm(), 0.5);
}

}  // namespace
}  // namespace grid_path_planner::localization
