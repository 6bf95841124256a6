// The yaw of an orientation that must lie level, as a map's origin and a waypoint do.
#pragma once

namespace grid_path_planner::base {

constexpr double kLargestTilt = 1e-3;  // radians of roll and pitch together that count as level

// Radians, anticlockwise about z, in [-pi, pi]. The quaternion need not have length 1. Throws
// InputError with its numbers where one is not finite, its length is zero (below 1e-6) or it tilts
// by more than kLargestTilt.
double yawOfLevelQuaternion(double x, double y, double z, double w);

}  // namespace grid_path_planner::base
