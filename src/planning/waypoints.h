// The poses of a path that a waypoint file holds.
#pragma once

#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/path/path.h"
#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::planning {

// The corners of `path`, but for those that a straight line past them comes within
// waypoint_tolerance of, as far as that line keeps the distances that the costmap keeps, those to
// unknown cells and to the border no more than both ends have; and in each line evenly as many poses
// as waypoint_spacing asks for. With min_turning_radius all corners stay, since they are points of curves. The ends stay, the headings are made anew. `costs` is the costmap at
// full resolution that the path was planned on.
path::Path waypointsOf(const path::Path& path, const PlannerOptions& options,
                       const costmap::CostGrid& costs);

}  // namespace grid_path_planner::planning
