// Why there is no path, beyond the status: the narrowest gap on the path that a smaller vehicle
// would take, unknown cells where no others lead, and the place nearest the goal in reach.
//
//   const Plan plan = planner.plan(request);
//   if (!plan.found()) log(explainFailure(planner, request, plan.status, stop).text);
//
// It takes some tens of milliseconds for a million cells, and is therefore asked for apart.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "grid_path_planner/base/status.h"
#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::planning {

struct Gap {
  Eigen::Vector2d position;     // the middle of the gap, in metres
  double width = 0.0;           // m, across it
  double largest_radius = 0.0;  // m; of the largest vehicle for which there is a path: it is exact
};

struct Explanation {
  std::string text;  // half a sentence that goes on from the plan's message; empty: nothing to add
  std::optional<Gap> gap;
  bool only_unknown = false;               // the goal is reached through unknown cells only
  std::optional<Eigen::Vector2d> nearest;  // the reachable cell nearest the goal, in metres
};

// Of a request that `planner` answered with `status` on its present map and options: UNREACHABLE or
// GOAL_OCCUPIED, nothing for any other, for starts in blocked cells and for maps of more than
// kMostExplained cells. Throws Stopped, and InputError where the costmaps take too much memory.
Explanation explainFailure(PathPlanner& planner, const PoseRequest& request, base::Status status,
                           const base::StopToken& stop);

constexpr std::size_t kMostExplained = std::size_t{1} << 22;

}  // namespace grid_path_planner::planning
