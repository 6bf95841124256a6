// Which way a vehicle looks along a path.
#pragma once

#include <utility>
#include <vector>

#include "grid_path_planner/path/path.h"

namespace grid_path_planner {

// As users of navfn and global_planner know them (global_planner's orientation_mode).
enum class HeadingMode {
  NONE,                      // yaw 0 but for the last pose, which has the goal's
  FORWARD,                   // along the next segment; the last pose has the goal's
  INTERPOLATE,               // from the start's to the goal's by length, the shorter way round
  FORWARD_THEN_INTERPOLATE,  // forward; over the last segment turning to the goal's
  BACKWARD,
  LEFTWARD,
  RIGHTWARD,
};
const std::vector<std::pair<const char*, HeadingMode>>& choicesOf(HeadingMode);

// Sets the yaw of every pose from the positions, and the goal's at the last one in every mode.
// Coinciding poses take the heading of the next segment that has a length.
void applyHeadings(Path& path, double start_yaw, double goal_yaw, HeadingMode mode);

// What the z of the poses between two ends is.
enum class PathZ { INTERPOLATE, START, GOAL, FIXED };
const std::vector<std::pair<const char*, PathZ>>& choicesOf(PathZ);

// Sets every pose's z: by horizontal length from `start_z` to `goal_z`, the one or the other, or
// `fixed_z`.
void applyZ(Path& path, double start_z, double goal_z, double fixed_z, PathZ mode);

}  // namespace grid_path_planner
