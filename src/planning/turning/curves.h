// Curves in the place of a plan's corners, where options ask for a least turning radius (curved_path.h).
#pragma once

#include <functional>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::planning {

// What changes path, cost and sharp_corners of a plan that is found, for a request with these headings at its ends; null where
// min_turning_radius is 0. Its curves keep the distances that `costs` keeps, or are legal on it without any; those to unknown
// cells and to the border no more than the ends have. `fits`: whether a path with headings may be driven; null: any.
// All but the request outlive it.
std::function<void(Plan&)> curvesFor(const PoseRequest& request, const PlannerOptions& options,
                                     const costmap::CostGrid& costs,
                                     std::function<bool(const path::Path&)> fits,
                                     const base::StopToken& stop);

}  // namespace grid_path_planner::planning
