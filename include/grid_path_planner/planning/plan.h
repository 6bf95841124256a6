// The answer to a request for a path between two poses.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/status.h"
#include "grid_path_planner/costmap/exact_cost.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::planning {

struct Plan {
  base::Status status = base::Status::NO_MAP;
  std::string message;      // one sentence that holds the values
  std::string answered_by;  // the planner that searched the longest part, where it lets another one
                            // answer the name of that; empty where none searched
  path::Path path;          // its corners; empty unless FOUND
  path::Path waypoints;     // the same for a file: see waypoint_tolerance, waypoint_spacing
  costmap::ExactCost cost;  // between the end cells, as in SearchResult
  double segment_cost = 0.0;
  double costValue() const { return cost.toDouble() + segment_cost; }
  bool optimal = false;  // the planner promises that no path of its kind (over the grid, or at
                         // any angle) costs less; never of a kernel or a smoothed path
  double length_m = 0.0;
  std::size_t cells = 0;  // of the path on the map that was searched
  int kernel = 1;         // of the map that the longest part was searched on
  base::Statistics statistics;
  std::size_t sharp_corners = 0;    // with min_turning_radius: those at which no curve fits
  double preparation_time_s = 0.0;  // costmaps and the planner's preparation; 0 if nothing changed
  std::vector<Eigen::Vector2d> expanded;  // centres of the expanded cells, metres

  bool found() const { return status == base::Status::FOUND; }
};

// Without a path.
inline Plan failedPlan(base::Status status, std::string message) {
  Plan plan;
  plan.status = status;
  plan.message = std::move(message);
  return plan;
}

}  // namespace grid_path_planner::planning
