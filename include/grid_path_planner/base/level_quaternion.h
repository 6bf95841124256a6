// The yaw of an orientation, of which roll and pitch are told or must be none, as a map's origin's.
#pragma once

namespace grid_path_planner::base {

constexpr double kLargestTilt = 1e-3;  // radians of roll and pitch together that count as level

struct YawAndTilt {
  double yaw = 0.0;   // rad, of the x axis in the horizontal plane, anticlockwise, in [-pi, pi]
  double tilt = 0.0;  // rad, between the z axis and the vertical, in [0, pi]
};

// The quaternion need not have length 1. Throws InputError with its numbers where one is not finite
// or its length is zero (below 1e-6).
YawAndTilt yawAndTiltOfQuaternion(double x, double y, double z, double w);

// The yaw. Throws InputError as above, and where it tilts by more than kLargestTilt.
double yawOfLevelQuaternion(double x, double y, double z, double w);

}  // namespace grid_path_planner::base
