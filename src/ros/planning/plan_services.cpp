#include "ros/planning/plan_services.h"

#include <chrono>
#include <optional>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/guard/incoming/advertised_service.h"
#include "ros/messages/file_kinds.h"
#include "ros/planning/requests/request_messages.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::Status;
using path::Path;
using path::writeWaypointFile;
using planning::Explanation;
using planning::failedPlan;

namespace {

constexpr std::chrono::milliseconds kAsksCaller(20);

// Cancels what is asked for nobody.
void waitForAnswer(PlanTicket& ticket, const ServiceCaller& caller) {
  while (!ticket.waitFor(kAsksCaller))
    if (caller.gone()) ticket.cancel();
}

void add(PlanStatistics statistics, const Path& path, ComparePlans::Response& response) {
  const ros::Time now = ros::Time::now();
  statistics.header.stamp = now;
  response.results.push_back(std::move(statistics));
  response.paths.push_back(pathToMessage(path, now));
}

geometry_msgs::Point pointAt(const Eigen::Vector2d& position) {
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  return point;
}

ExplainPlan::Response explanationMessage(const Explanation& explanation) {
  ExplainPlan::Response message;
  message.only_unknown = explanation.only_unknown;
  message.has_gap = explanation.gap.has_value();
  if (explanation.gap) {
    message.gap = pointAt(explanation.gap->position);
    message.gap_width_m = explanation.gap->width;
    message.largest_radius_m = explanation.gap->largest_radius;
  }
  message.has_nearest = explanation.nearest.has_value();
  if (explanation.nearest) message.nearest = pointAt(*explanation.nearest);
  return message;
}

}  // namespace

PlanServices::PlanServices(ros::NodeHandle private_nh, PlanningServer& server)
    : server_(server), spinner_(2, &queue_), file_spinner_(1, &file_queue_) {
  private_nh.setCallbackQueue(&guarded_);
  make_plan_ = advertiseServiceBySpec<MakePlan>(private_nh, "make_plan",
                                                [this](MakePlan& call) { return makePlan(call); });
  compare_plans_ = advertiseServiceBySpec<Comparison>(
      private_nh, "compare_plans", [this](Comparison& call) { return comparePlans(call); });
  explain_plan_ = advertiseServiceBySpec<Why>(private_nh, "explain_plan",
                                              [this](Why& call) { return explainPlan(call); });
  private_nh.setCallbackQueue(&guarded_files_);
  save_waypoints_ = advertiseService<SaveWaypoints>(
      private_nh, "save_waypoints",
      [this](auto& request, auto& response) { return saveWaypoints(request, response); });
  spinner_.start();
  file_spinner_.start();
}

PlanServices::~PlanServices() {
  make_plan_.shutdown();
  compare_plans_.shutdown();
  explain_plan_.shutdown();
  save_waypoints_.shutdown();
  spinner_.stop();
  file_spinner_.stop();
}

bool PlanServices::makePlan(MakePlan& call) {
  const ServiceCaller caller(make_plan_.getService(), call.getConnectionHeader());
  const auto ticket = server_.ask(requestOf(call.getRequest()), PlanningServer::Publish::YES);
  while (!ticket->waitForPoses(kAsksCaller))
    if (caller.gone()) ticket->cancel();
  call.getResponse().plan = pathToMessage(ticket->poses(), ros::Time::now());
  return true;
}

bool PlanServices::comparePlans(Comparison& call) {
  const ServiceCaller caller(compare_plans_.getService(), call.getConnectionHeader());
  const std::vector<PlanningRequest> requests = requestsOf(call.getRequest());
  if (requests.size() <= kMostQuestions) {
    compare(requests, caller, call.getResponse());
  } else {
    PlanStatistics refusal = statisticsMessage(failedPlan(
        Status::INVALID_REQUEST, "a comparison has at most " + std::to_string(kMostQuestions) +
                                     " questions, which planners times heuristics exceed"));
    add(refusal, Path(), call.getResponse());
  }
  return true;
}

void PlanServices::compare(const std::vector<PlanningRequest>& requests,
                           const ServiceCaller& caller, ComparePlans::Response& response) {
  for (const PlanningRequest& request : requests) {
    if (caller.gone()) return;
    const auto ticket = server_.ask(request, PlanningServer::Publish::NO);
    waitForAnswer(*ticket, caller);
    add(ticket->statistics(), ticket->poses(), response);
  }
}

bool PlanServices::explainPlan(Why& call) {
  const ServiceCaller caller(explain_plan_.getService(), call.getConnectionHeader());
  const auto ticket = server_.ask(requestOf(call.getRequest()), PlanningServer::Publish::NO,
                                  PlanningServer::Explain::YES);
  waitForAnswer(*ticket, caller);
  ExplainPlan::Response& response = call.getResponse();
  response = explanationMessage(ticket->explanation());
  response.status = toString(ticket->plan().status);
  response.message = ticket->plan().message;
  return true;
}

bool PlanServices::saveWaypoints(SaveWaypoints::Request& request,
                                 SaveWaypoints::Response& response) {
  const std::string file =
      request.filename.empty() ? server_.settings().options.waypoints_file : request.filename;
  const std::optional<Path> waypoints = server_.lastAnswer()->waypoints;
  if (file.empty()) {
    response.message = "no filename was given and ~waypoints_file is empty";
  } else if (!waypoints) {
    response.message = "no path has been found yet";
  } else {
    try {
      const base::OutputFile output =
          server_.files().toWrite("waypoints_file", file, waypointFiles());
      writeWaypointFile(output, *waypoints);
      response.success = true;
      response.message = std::to_string(waypoints->poses.size()) + " waypoints in " + output.name();
    } catch (const InputError& error) {
      response.message = error.what();
    }
  }
  return true;
}

}  // namespace grid_path_planner::nodes
