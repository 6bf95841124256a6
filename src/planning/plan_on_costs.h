// Plans between two poses on a costmap that is there: ends, search, smoothing, poses, message.
//
//   Plan plan = planWithin(timeout, request, source, [&](const StopToken& token) {
//     search.prepare(costmaps, token);
//     return planOnCosts(costs, search, request, options, token);
//   });
//
// What PathPlanner, which makes costmaps of occupancy maps, and CostPlanner, to whom costs are given,
// have in common.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planning/path_planner.h"
#include "grid_path_planner/planning/plan.h"
#include "planning/multi_resolution_planner.h"

namespace grid_path_planner::planning {

// What a vehicle's footprint and its turning radius add to a plan.
struct VehicleTerms {
  // What is wrong with a pose at the end of a path; "" where nothing is. Null: nothing ever is.
  std::function<std::string(const path::Pose&)> complaint;
  // The costs that are told of a path over the grid or its smoothed one, where others are searched; else null.
  const costmap::CostGrid* priced = nullptr;
  // Where the path begins and ends in the place of the request's poses, to which straight lines lead it.
  std::optional<path::Pose> from;
  std::optional<path::Pose> to;
  // Changes the path of a plan and its cost, before the path is measured. Null: nothing does.
  std::function<void(Plan&)> shape;
};

// `costs` is the costmap at full resolution, for which `search` is prepared. Throws Stopped, and what
// searches throw. Precondition: the poses are finite.
Plan planOnCosts(const costmap::CostGrid& costs, MultiResolutionPlanner& search,
                 const PoseRequest& request, const PlannerOptions& options,
                 const base::StopToken& stop, const VehicleTerms& terms = {});

// What `work` gives, or the status and the sentence of Stopped, TooExpensive or InputError that it
// throws; INVALID_REQUEST without it for poses that are not finite. `timeout`: seconds, 0: none.
Plan planWithin(double timeout, const PoseRequest& request, const base::StopSource& stop,
                const std::function<Plan(const base::StopToken&)>& work);

}  // namespace grid_path_planner::planning
