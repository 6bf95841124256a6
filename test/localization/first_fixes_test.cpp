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

}  // namespace
}  // namespace grid_path_planner::localization
