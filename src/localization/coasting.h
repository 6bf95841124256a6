// How the state moves on without an IMU: at constant velocity and attitude, both random walks.
//
//   coast(estimate, seconds, noise);
#pragma once

#include "localization/state.h"

namespace grid_path_planner::localization {

struct CoastingNoise {
  double acceleration = 0.0;        // of the velocity, m/s/sqrt(s)
  double turn = 0.0;                // of the attitude, rad/sqrt(s)
  double gyro_walk = 0.0;           // rad/s^2/sqrt(Hz)
  double accelerometer_walk = 0.0;  // m/s^3/sqrt(Hz)
};

void coast(Estimate& estimate, double seconds, const CoastingNoise& noise);

}  // namespace grid_path_planner::localization
