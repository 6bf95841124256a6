// What the log says of a drive.
#pragma once

#include "grid_path_planner/following/path_follower.h"

namespace grid_path_planner::nodes {

// A waypoint before the last that was reached is for debugging; a missed one, a retry and an obstacle are warnings.
void logEvent(const following::FollowEvent& event);

}  // namespace grid_path_planner::nodes
