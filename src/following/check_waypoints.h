// Whether a path can be driven at all.
#pragma once

#include "grid_path_planner/path/path.h"

namespace grid_path_planner::following {

// Throws InputError naming the waypoint (from 1) and the number for a path without waypoints,
// numbers that are not finite, coordinates beyond kLargestCoordinate; with `loop` for a path whose
// waypoints all lie in one place.
void checkWaypoints(const path::Path& path, bool loop);

}  // namespace grid_path_planner::following
