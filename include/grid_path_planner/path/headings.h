// The headings of a vehicle along a path, and its z.
//
//   applyHeadings(path, start.yaw, goal.yaw, HeadingMode::FORWARD);
//   applyZ(path, start.position.z(), goal.position.z(), 0.0, PathZ::INTERPOLATE);
//
// Both use the positions in the plane only, leave an empty path empty and keep x and y. Computed
// yaws lie in [-pi, pi]; the goal's yaw is kept to the last bit.
#pragma once

#include <utility>
#include <vector>

#include "grid_path_planner/path/path.h"

namespace grid_path_planner::path {

// As users of navfn and global_planner know them (global_planner's orientation_mode).
enum class HeadingMode {
  NONE,         // yaw 0 but for the last pose, which has the goal's
  FORWARD,      // along the next segment; the last pose has the goal's
  INTERPOLATE,  // from the start's to the goal's by length, in the direction of the smaller turn
  FORWARD_THEN_INTERPOLATE,  // forward; over the last straight stretch turning to the goal's
  BACKWARD,                  // the vehicle's back along the path
  LEFTWARD,                  // its left side (+y) along the path
  RIGHTWARD,                 // its right side (-y) along the path
};
const std::vector<std::pair<const char*, HeadingMode>>& choicesOf(HeadingMode);

// Sets the yaw of every pose from the positions, and the goal's at the last one in every mode.
// Coinciding poses take the heading of the next segment that has a length, those at the end the
// goal's. A turn by pi goes anticlockwise. Where no segment has a
// length, INTERPOLATE turns by equal steps a pose. Precondition: everything is finite.
void applyHeadings(Path& path, double start_yaw, double goal_yaw, HeadingMode mode);

// The heading with which a vehicle arrives that is not asked for one at the goal: that of the last segment with a length,
// as the mode turns it; the start's with INTERPOLATE and where no segment has one, 0 with NONE. Precondition: not empty.
double arrivalYaw(const Path& path, double start_yaw, HeadingMode mode);

// Gives poses whose yaw is NaN the direction of the path there, at its end that of the last segment.
void lookAlongPath(Path& path);

// The z of the poses between the two ends.
enum class PathZ { INTERPOLATE, START, GOAL, FIXED };
const std::vector<std::pair<const char*, PathZ>>& choicesOf(PathZ);

// Sets every pose's z: by horizontal length from `start_z` to `goal_z` (by equal steps a pose where
// no segment has a length; a single pose has the goal's), the one or the other, or `fixed_z`.
void applyZ(Path& path, double start_z, double goal_z, double fixed_z, PathZ mode);

}  // namespace grid_path_planner::path
