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

// Whether it is of zeros. octomap_server sets the position of its maps' origin alone, and rviz and costmap_2d take the
// zeros for no turn. A goal of zeros is another thing: it has no heading.
bool isZeroQuaternion(double x, double y, double z, double w);

// The yaw of a map's origin: 0 of zeros, else as above.
double yawOfMapOrigin(double x, double y, double z, double w);

// What is told of a map whose origin has such a one, or, in map_server's YAML, a yaw that is not a number.
constexpr char kYawAssumed[] = "its origin has no orientation: yaw 0 is taken";

}  // namespace grid_path_planner::base
