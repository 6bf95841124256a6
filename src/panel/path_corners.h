// What a waypoint file needs of a path whose poses stand close together.
#pragma once

#include "grid_path_planner/path/path.h"

namespace grid_path_planner::panel {

// Without the poses that lie within a micrometre of the straight line from the last one kept to the
// next one; the ends stay.
path::Path cornersOf(const path::Path& path);

}  // namespace grid_path_planner::panel
