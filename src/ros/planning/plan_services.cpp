#include "ros/planning/plan_services.h"

#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/common/file_kinds.h"

namespace grid_path_planner::nodes {

using base::InputError;
using path::Path;
using path::writeWaypointFile;
using planners::plannerNames;

namespace {

// A start without a frame stands for the vehicle's pose.
std::optional<geometry_msgs::PoseStamped> startOf(const geometry_msgs::PoseStamped& start) {
  return start.header.frame_id.empty() ? std::nullopt : std::make_optional(start);
}

// One request for every planner with each of the heuristics that it can use.
std::vector<PlanningRequest> requestsOf(const ComparePlans::Request& compared) {
  std::vector<PlanningRequest> requests;
  PlanningRequest request;
  request.start = startOf(compared.start);
  request.goal = compared.goal;
  for (const std::string& planner :
       compared.planners.empty() ? plannerNames() : compared.planners) {
    request.planner = planner;
    const bool several = usesHeuristic(planner) && !compared.heuristics.empty();
    for (const std::string& heuristic :
         several ? compared.heuristics : std::vector<std::string>{""}) {
      request.heuristic = heuristic;
      requests.push_back(request);
    }
  }
  return requests;
}

}  // namespace

PlanServices::PlanServices(ros::NodeHandle private_nh, PlanningServer& server)
    : server_(server), spinner_(2, &queue_) {
  private_nh.setCallbackQueue(&guarded_);
  make_plan_ = private_nh.advertiseService("make_plan", &PlanServices::makePlan, this);
  compare_plans_ = private_nh.advertiseService("compare_plans", &PlanServices::comparePlans, this);
  save_waypoints_ =
      private_nh.advertiseService("save_waypoints", &PlanServices::saveWaypoints, this);
  spinner_.start();
}

PlanServices::~PlanServices() {
  make_plan_.shutdown();
  compare_plans_.shutdown();
  save_waypoints_.shutdown();
  spinner_.stop();
}

bool PlanServices::makePlan(nav_msgs::GetPlan::Request& request,
                            nav_msgs::GetPlan::Response& response) {
  PlanningRequest plan_request;
  plan_request.start = startOf(request.start);
  plan_request.goal = request.goal;
  if (request.tolerance != 0.0F) plan_request.tolerance = request.tolerance;
  const auto ticket = server_.ask(plan_request, PlanningServer::Publish::YES);
  ticket->wait();
  response.plan = pathToMessage(ticket->plan().path, ros::Time::now());
  return true;
}

bool PlanServices::comparePlans(ComparePlans::Request& request, ComparePlans::Response& response) {
  for (const PlanningRequest& plan_request : requestsOf(request)) {
    const auto ticket = server_.ask(plan_request, PlanningServer::Publish::NO);
    ticket->wait();
    const ros::Time now = ros::Time::now();
    response.results.push_back(ticket->statistics());
    response.results.back().header.stamp = now;
    response.paths.push_back(pathToMessage(ticket->plan().path, now));
  }
  return true;
}

bool PlanServices::saveWaypoints(SaveWaypoints::Request& request,
                                 SaveWaypoints::Response& response) {
  const std::string file =
      request.filename.empty() ? server_.settings().options.waypoints_file : request.filename;
  const std::optional<Path> path = server_.lastPath();
  if (file.empty()) {
    response.message = "no filename was given and ~waypoints_file is empty";
  } else if (!path) {
    response.message = "no path has been found yet";
  } else {
    try {
      writeWaypointFile(server_.files().toWrite("waypoints_file", file, waypointFiles()), *path);
      response.success = true;
      response.message = std::to_string(path->poses.size()) + " waypoints in " + file;
    } catch (const InputError& error) {
      response.message = error.what();
    }
  }
  return true;
}

}  // namespace grid_path_planner::nodes
