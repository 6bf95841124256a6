// The poses of a request in the map's frame.
//
//   const planning::ViaRequest poses = posesOf(request, options, transforms, "map", stop);
#pragma once

#include <optional>
#include <string>

#include "grid_path_planner/base/stop_token.h"
#include "planning/via/via_plan.h"
#include "ros/input/frame_lookup.h"
#include "ros/planning/planning_request.h"

namespace grid_path_planner::nodes {

// How old the vehicle's pose may be where a plan starts from it, in seconds; none: as old as it is.
std::optional<double> oldestStart(const PathPlannerNodeOptions& options);

// Transforms are waited for as options.tf_timeout says. Throws InputError for poses that are none, an order
// that is none and more via-points than planning::kMostVia, TransformError, Stopped.
planning::ViaRequest posesOf(const PlanningRequest& request, const PathPlannerNodeOptions& options,
                             const FrameLookup& transforms, const std::string& map_frame,
                             const base::StopToken& stop);

}  // namespace grid_path_planner::nodes
