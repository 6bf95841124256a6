// A route as a path: the poses asked for at its ends, the cells between them.
#pragma once

#include "grid_path_planner/path/path.h"
#include "grid_path_planner/planning/multi_resolution_planner.h"

namespace grid_path_planner::planning {

// The positions (z 0) and no headings yet. The ends are `start` and `goal`, in metres. The centre
// of the first or last cell stays between an end and the rest only where the straight way past it
// is not legal, or where `keep_first` asks for it (a start that is itself blocked). start = goal:
// one pose. Precondition: route.status is FOUND.
path::Path pathOfRoute(const Route& route, const Eigen::Vector2d& start,
                       const Eigen::Vector2d& goal, bool keep_first);

}  // namespace grid_path_planner::planning
