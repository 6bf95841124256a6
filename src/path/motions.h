// The motions of a vehicle along a path, one after another: it drives straight from pose to pose, and turns on the spot where
// its heading changes at a pose.
//
//   for (const vehicle::Motion& motion : motionsAlong(path, start.yaw, goal.yaw, HeadingMode::FORWARD)) check(motion);
//
// Turns on the spot are the smaller ones. A vehicle that has to turn by about half a circle may turn to either side: then both
// motions are there.
#pragma once

#include <optional>
#include <vector>

#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/path/path.h"
#include "vehicle/motion.h"

namespace grid_path_planner::path {

// The direction in which a vehicle of this heading drives; none where the heading says nothing of it (INTERPOLATE).
std::optional<double> drivingDirection(double yaw, HeadingMode mode);

// `path` has headings of `mode` (headings.h); with NONE the vehicle looks along it. From the heading `start_yaw`, where it
// is given, to the heading `goal_yaw`, where that is: else the vehicle stays as it arrives. A path of one
// pose, and turns of nothing, give motions that do not move; an empty one gives none.
std::vector<vehicle::Motion> motionsAlong(const Path& path, std::optional<double> start_yaw,
                                          std::optional<double> goal_yaw, HeadingMode mode);

}  // namespace grid_path_planner::path
