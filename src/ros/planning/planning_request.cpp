#include "ros/planning/planning_request.h"

#include <algorithm>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

using base::choiceFromName;
using base::choiceName;
using base::InputError;
using planners::Heuristic;
using planners::plannerNames;
using planners::traitsOf;
using planning::PlannerOptions;

void checkText(const PlanningRequest& request) {
  checkNetworkText("the planner", request.planner);
  checkNetworkText("the heuristic", request.heuristic);
  checkNetworkText("the order", request.order);
  if (request.start) frameName(request.start->header.frame_id);
  for (const geometry_msgs::PoseStamped& via : request.via_points) frameName(via.header.frame_id);
  if (!request.closed) return void(frameName(request.goal.header.frame_id));
  if (request.goal != geometry_msgs::PoseStamped())
    throw InputError("a closed trip ends at its start: its goal must be left empty");
}

PlanningRequest printable(PlanningRequest request) {
  request.planner = printable(request.planner);
  request.heuristic = printable(request.heuristic);
  if (request.start) request.start->header.frame_id = printable(request.start->header.frame_id);
  request.goal.header.frame_id = printable(request.goal.header.frame_id);
  return request;
}

bool usesHeuristic(const std::string& planner) {
  const std::vector<std::string>& known = plannerNames();
  const bool exists = std::find(known.begin(), known.end(), planner) != known.end();
  return exists && traitsOf(planner).heuristic;
}

std::string plannerOf(const PlanningRequest& request, const PathPlannerNodeOptions& options) {
  return request.planner.empty() ? options.planner.planner : request.planner;
}

std::string heuristicOf(const PlanningRequest& request, const PathPlannerNodeOptions& options) {
  if (!usesHeuristic(plannerOf(request, options))) return "";
  return request.heuristic.empty() ? choiceName(options.planner.search.heuristic)
                                   : request.heuristic;
}

PlannerOptions optionsFor(const PlanningRequest& request, const PathPlannerNodeOptions& options) {
  PlannerOptions merged = options.planner;
  merged.planner = plannerOf(request, options);
  if (!request.heuristic.empty())
    merged.search.heuristic = choiceFromName<Heuristic>("heuristic", request.heuristic);
  if (request.tolerance) merged.tolerance = *request.tolerance;
  return merged;
}

}  // namespace grid_path_planner::nodes
