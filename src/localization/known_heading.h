// How far the heading of the IMU was off at some time: that of a plain one drifts.
#pragma once

#include "localization/measurement.h"

namespace grid_path_planner::localization {

struct KnownHeading {
  Stamp stamp = 0;
  double offset = 0.0;    // rad, of the IMU's yaw less the true one
  double variance = 0.0;  // rad^2
};

}  // namespace grid_path_planner::localization
