// A request for a path as the topics, the services and the action of path_planner make it.
#pragma once

#include <geometry_msgs/PoseStamped.h>

#include <optional>
#include <string>
#include <vector>

#include "ros/planning/path_planner_options.h"

namespace grid_path_planner::nodes {

struct PlanningRequest {
  std::optional<geometry_msgs::PoseStamped> start;  // none: the vehicle's pose from tf
  geometry_msgs::PoseStamped goal;
  std::vector<geometry_msgs::PoseStamped> via_points;
  std::string order;                // "given", "best"; empty: given
  bool closed = false;              // the goal is the start
  std::string planner;              // empty: the node's
  std::string heuristic;            // empty: the node's
  std::optional<double> tolerance;  // m; none: the node's
};

// Throws InputError for names of planners, heuristics and frames that are no names
// (ros/guard/network_text.h).
void checkText(const PlanningRequest& request);

// The request as an answer may repeat it: such names are empty.
PlanningRequest printable(PlanningRequest request);

// Whether there is a planner of this name and it is guided by a heuristic.
bool usesHeuristic(const std::string& planner);

// The planner that the request names, else the node's; and the heuristic that guides it, "" where
// it uses none.
std::string plannerOf(const PlanningRequest& request, const PathPlannerNodeOptions& options);
std::string heuristicOf(const PlanningRequest& request, const PathPlannerNodeOptions& options);

// The node's options with those that the request sets. Throws InputError for an unknown heuristic.
planning::PlannerOptions optionsFor(const PlanningRequest& request,
                                    const PathPlannerNodeOptions& options);

}  // namespace grid_path_planner::nodes
