// What `search_markers` shows of a plan.
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "grid_path_planner/PlanStatistics.h"
#include "grid_path_planner/planning/plan.h"

namespace grid_path_planner::nodes {

struct ShownPlan {
  planning::Plan plan;
  PlanStatistics statistics;                    // stamped
  double cell_size = 1.0;                       // m, of the map that was searched
  double radius = 0.0;                          // m, that is kept; 0: no disc about the vehicle
  std::string base_frame;                       // the vehicle's
  std::vector<Eigen::Vector2d> footprint = {};  // m, base_frame; empty: round
  double map_side = 0.0;                        // m, the longer one of the map; 0: no map
};

// Namespaces "expanded" (cells; at most 50,000 of them, evenly chosen), "waypoints" (corners), "start"
// (a green disc), "goal" (an orange arrow where the vehicle looks then), "vehicle" (a disc of the
// radius or the footprint's outline, which moves with base_frame) and "failure" (the status with its sentence, above the goal that
// was asked for, in letters that can be read where all of the map is in view). One with nothing to show is deleted from the display.
visualization_msgs::MarkerArray planMarkers(const ShownPlan& shown);

}  // namespace grid_path_planner::nodes
