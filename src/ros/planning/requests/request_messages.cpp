#include "ros/planning/requests/request_messages.h"

#include <optional>
#include <string>

#include "grid_path_planner/planners/planner_factory.h"

namespace grid_path_planner::nodes {
namespace {

// A start without a frame stands for the vehicle's pose.
std::optional<geometry_msgs::PoseStamped> startOf(const geometry_msgs::PoseStamped& start) {
  return start.header.frame_id.empty() ? std::nullopt : std::make_optional(start);
}

template <class Message>
PlanningRequest betweenPosesOf(const Message& message) {
  PlanningRequest request;
  request.start = startOf(message.start);
  request.goal = message.goal;
  return request;
}

}  // namespace

PlanningRequest requestOf(const nav_msgs::GetPlan::Request& asked) {
  PlanningRequest request = betweenPosesOf(asked);
  if (asked.tolerance != 0.0F) request.tolerance = asked.tolerance;
  return request;
}

PlanningRequest requestOf(const ExplainPlan::Request& asked) {
  return betweenPosesOf(asked);
}

PlanningRequest requestOf(const PlanPathGoal& goal) {
  PlanningRequest request = betweenPosesOf(goal);
  request.via_points = goal.via_points;
  request.order = goal.order;
  request.closed = goal.closed;
  request.planner = goal.planner;
  if (goal.tolerance_m != 0.0) request.tolerance = goal.tolerance_m;
  return request;
}

std::vector<PlanningRequest> requestsOf(const ComparePlans::Request& compared) {
  std::vector<PlanningRequest> requests;
  PlanningRequest request = betweenPosesOf(compared);
  for (const std::string& planner :
       compared.planners.empty() ? planners::plannerNames() : compared.planners) {
    request.planner = planner;
    const bool several = usesHeuristic(planner) && !compared.heuristics.empty();
    for (const std::string& heuristic :
         several ? compared.heuristics : std::vector<std::string>{""}) {
      request.heuristic = heuristic;
      requests.push_back(request);
      if (requests.size() > kMostQuestions) return requests;
    }
  }
  return requests;
}

}  // namespace grid_path_planner::nodes
