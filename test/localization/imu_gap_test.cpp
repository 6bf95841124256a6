// An IMU whose heading has drifted and that is silent in mid-drive: the pose begins anew, and the heading with it.
#include <gtest/gtest.h>

#include <cmath>

#include "localization/support/simulated_sensors.h"
#include "localization/vehicle_localizer.h"

namespace grid_path_planner::localization {
namespace {

// The heading is half a radian off before the IMU is silent from 20 to 22.5 s, and off by `after` then. With a DVL and
// depth the tilt would stay known for longer.
std::vector<Measurement> gapRun(SimulatedSensors& sensors, double after) {
  sensors.cut = [](Source source, double t) {
    return source != Source::USBL && t > 20.0 && t < 22.5;
  };
  const State truth = sensors.truthAt(0.0);
  std::vector<Measurement> all = {
      {stampAt(0.0), Source::SET_POSE,
       PoseFix{truth.position, truth.attitude, 0.01 * PoseCovariance::Identity(), {}}}};
  for (Measurement& measurement : sensors.run(40.0)) {
    if (auto* imu = std::get_if<ImuMeasurement>(&measurement.data)) {
      const double drift = measurement.stamp > stampAt(21.0) ? after : 0.5;
      imu->attitude = Eigen::AngleAxisd(drift, Eigen::Vector3d::UnitZ()) * *imu->attitude;
    }
    all.push_back(measurement);
  }
  return all;
}

struct AfterGap {
  bool began_anew = false;                  // there was no pose
  std::optional<LocalizationStatus> first;  // with which it began
  double largest_said_ok = 0.0;             // rad, of the yaw while the status was OK
  double last = 0.0;                        // rad, at the end
};

AfterGap afterGap(unsigned seed, double drift_after) {
  SimulatedSensors sensors(seed);
  VehicleLocalizer localizer{LocalizerOptions{}};
  AfterGap gap;
  for (const Measurement& measurement : gapRun(sensors, drift_after)) {
    localizer.add(measurement);
    if (measurement.stamp < stampAt(22.5) || measurement.source != Source::DEPTH) continue;
    const auto snapshot = localizer.mapAt(measurement.stamp);
    gap.began_anew = gap.began_anew || !snapshot;
    if (!gap.began_anew || !snapshot) continue;
    const State truth = sensors.truthAt(secondsBetween(kStart, measurement.stamp));
    gap.last = std::abs(std::remainder(
        yawOf(snapshot->estimate.state.attitude) - yawOf(truth.attitude), 2.0 * M_PI));
    const LocalizationStatus status = localizer.report(measurement.stamp).status;
    if (!gap.first) gap.first = status;
    if (status == LocalizationStatus::OK)
      gap.largest_said_ok = std::max(gap.largest_said_ok, gap.last);
  }
  return gap;
}

// It was OK with the heading of the IMU, half a radian off: what had been known of it was dropped.
TEST(ImuGap, TheHeadingThatWasKnownIsKnownAfterIt) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const AfterGap gap = afterGap(seed, 0.5);
    EXPECT_TRUE(gap.began_anew) << seed;
    EXPECT_LT(gap.largest_said_ok, 0.15) << seed;
    EXPECT_LT(gap.last, 0.15) << seed;
  }
}

// It begins with another heading, of which nothing is known.
TEST(ImuGap, OfAnImuThatWasStartedAgainTheHeadingIsUnknown) {
  for (const double after : {-1.5, 2.5})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const AfterGap gap = afterGap(seed, after);
      EXPECT_TRUE(gap.began_anew) << seed;
      EXPECT_EQ(gap.first, LocalizationStatus::LOST) << seed << ", " << after;
    }
}

}  // namespace
}  // namespace grid_path_planner::localization
