// The poses of a request in the map's frame.
//
//   const planning::ViaRequest poses = posesOf(request, options, transforms, "map", stop);
#pragma once

#include <string>

#include "grid_path_planner/base/stop_token.h"
#include "planning/via/via_plan.h"
#include "ros/input/frame_lookup.h"
#include "ros/planning/planning_request.h"

namespace grid_path_planner::nodes {

// Of poses in the map's frame by transforms of at most options.tf_timeout, which are waited for as long; 0: of any age, and
// without a wait.
Placing placingInMap(const PathPlannerNodeOptions& options, const std::string& map_frame,
                     const base::StopToken& stop = {});

// Poses are placed by placingInMap(). Throws InputError for poses that are none, an order
// that is none and more via-points than planning::kMostVia, TransformError, Stopped.
planning::ViaRequest posesOf(const PlanningRequest& request, const PathPlannerNodeOptions& options,
                             const FrameLookup& transforms, const std::string& map_frame,
                             const base::StopToken& stop);

}  // namespace grid_path_planner::nodes
