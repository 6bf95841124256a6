// Requests for paths, of the messages that ask for them.
//
//   const PlanningRequest request = requestOf(goal);                      // of the action
//   for (const PlanningRequest& each : requestsOf(comparison)) ask(each);
//
// Nothing is judged here but how many a comparison asks for: checkText() and posesOf() do that.
#pragma once

#include <nav_msgs/GetPlan.h>

#include <cstddef>
#include <vector>

#include "grid_path_planner/ComparePlans.h"
#include "grid_path_planner/ExplainPlan.h"
#include "grid_path_planner/PlanPathGoal.h"
#include "ros/planning/planning_request.h"

namespace grid_path_planner::nodes {

constexpr std::size_t kMostQuestions = 1000;  // of one comparison

PlanningRequest requestOf(const nav_msgs::GetPlan::Request& asked);
PlanningRequest requestOf(const ExplainPlan::Request& asked);
PlanningRequest requestOf(const PlanPathGoal& goal);

// One request for every planner with each of the heuristics that it can use; where they are too many,
// one more than may be asked.
std::vector<PlanningRequest> requestsOf(const ComparePlans::Request& compared);

}  // namespace grid_path_planner::nodes
