#include "ros/planning/planning_server.h"

#include <ros/console.h>

#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/common/file_kinds.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::Status;
using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::CostGrid;
using path::clearanceOf;
using path::Path;
using path::Pose;
using path::writeWaypointFile;
using planning::failedPlan;
using planning::Plan;
using planning::PoseRequest;

namespace {

Pose named(const char* which, const std::function<Pose()>& pose) {
  try {
    return pose();
  } catch (const InputError& error) {
    throw InputError(std::string("the ") + which + ": " + error.what());
  }
}

// Of the vehicle's pose, in seconds.
std::optional<double> oldestStart(const PathPlannerNodeOptions& options) {
  return options.tf_timeout > 0.0 ? std::make_optional(options.tf_timeout) : std::nullopt;
}

}  // namespace

PlanningServer::PlanningServer(ros::NodeHandle nh, const PathPlannerNodeOptions& options,
                               const NodeFiles& files, std::function<void()> on_time_jump)
    : files_(files),
      on_time_jump_(std::move(on_time_jump)),
      settings_{options, 0},
      transforms_(nh),
      publisher_(nh) {}

PlanningServer::Settings PlanningServer::settings() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return settings_;
}

void PlanningServer::setOptions(const PathPlannerNodeOptions& options) {
  std::lock_guard<std::mutex> lock(mutex_);
  settings_ = {options, settings_.revision + 1};
}

std::shared_ptr<PlanTicket> PlanningServer::ask(const PlanningRequest& request, Publish publish) {
  auto ticket = std::make_shared<PlanTicket>();
  ticket->task_ = worker_.post([this, ticket, request, publish](const StopSource& stop) {
    const PathPlannerNodeOptions options = settings().options;
    ticket->plan_ =
        plan(request, options, stop, [&](const char* phase) { ticket->phase_ = phase; });
    ticket->statistics_ = statistics(ticket->plan_, request, options);
    if (publish == Publish::YES && !stop.cancelled())
      this->publish(ticket->plan_, ticket->statistics_);
  });
  return ticket;
}

Plan PlanningServer::plan(const PlanningRequest& request, const PathPlannerNodeOptions& options,
                          const StopSource& stop, const PhaseListener& on_phase) {
  checkClock();
  Plan plan = tryToPlan(request, options, stop, on_phase);
  plan.path.frame_id = frame(options);
  if (!plan.found()) plan.path.poses.clear();
  return plan;
}

Plan PlanningServer::tryToPlan(const PlanningRequest& request,
                               const PathPlannerNodeOptions& options, const StopSource& stop,
                               const PhaseListener& on_phase) {
  try {
    checkText(request);
    waitForClock(stop.token());
    if (on_phase) on_phase("preparing");
    updateMap();
    planner_.setOptions(optionsFor(request, options));
    if (!planner_.hasMap())
      return failedPlan(Status::NO_MAP, "no map has come on " + maps_.topic() + " yet");
    PoseRequest poses = posesOf(request, options, stop.token());
    poses.record_expanded = options.record_search;
    if (on_phase) on_phase("searching");
    return planner_.plan(poses, stop);
  } catch (const InputError& error) {
    return failedPlan(Status::INVALID_REQUEST, error.what());
  } catch (const TransformError& error) {
    return failedPlan(Status::TRANSFORM_ERROR, error.what());
  } catch (const Stopped& stopped) {
    return failedPlan(stopped.status(), stopped.status() == Status::TIMEOUT
                                            ? "planning reached its time limit"
                                            : "planning was cancelled");
  }
}

PoseRequest PlanningServer::posesOf(const PlanningRequest& request,
                                    const PathPlannerNodeOptions& options,
                                    const StopToken& stop) const {
  const std::string map_frame = frame(options);
  PoseRequest poses;
  poses.goal = named("goal", [&] {
    return transforms_.poseIn(map_frame, request.goal, options.tf_timeout, stop);
  });
  poses.start = named("start", [&] {
    if (request.start)
      return transforms_.poseIn(map_frame, *request.start, options.tf_timeout, stop);
    return transforms_.poseOf(options.base_frame, map_frame, options.tf_timeout, stop,
                              oldestStart(options));
  });
  if (options.goal_z_from == GoalZ::VEHICLE) poses.goal.position.z() = poses.start.position.z();
  return poses;
}

PlanStatistics PlanningServer::statistics(const Plan& plan, const PlanningRequest& request,
                                          const PathPlannerNodeOptions& options) const {
  PlanStatistics message = statisticsMessage(plan);
  const PlanningRequest asked = printable(request);
  message.goal = asked.goal;
  message.planner = plannerOf(asked, options);
  message.heuristic = heuristicOf(asked, options);
  if (plan.found())
    message.clearance_m =
        clearanceOf(plan.path, *planner_.map(), options.planner.costmap.thresholds);
  return message;
}

void PlanningServer::updateMap() {
  const std::optional<MapChange> change = maps_.take();
  if (!change) return;
  map_frame_id_ = change->map.frame_id;
  if (!change->changed || !planner_.hasMap())
    planner_.setMap(change->map.grid);
  else if (!change->changed->empty())
    planner_.updateMap(change->map.grid, *change->changed);
}

std::shared_ptr<const CostGrid> PlanningServer::downsampledCosts(
    const PathPlannerNodeOptions& options, const StopToken& stop) {
  updateMap();
  planner_.setOptions(options.planner);
  return planner_.hasMap() ? planner_.downsampledCosts(stop) : nullptr;
}

std::shared_ptr<const CostGrid> PlanningServer::fullResolutionCosts(
    const PathPlannerNodeOptions& options, const StopToken& stop) {
  updateMap();
  planner_.setOptions(options.planner);
  return planner_.hasMap() ? planner_.fullResolutionCosts(stop) : nullptr;
}

std::string PlanningServer::frame(const PathPlannerNodeOptions& options) const {
  return map_frame_id_.empty() ? frameName(options.map_frame) : map_frame_id_;
}

std::optional<Eigen::Vector2d> PlanningServer::vehicle(
    const PathPlannerNodeOptions& options) const {
  try {
    return transforms_.poseOf(options.base_frame, frame(options), 0.0, StopToken())
        .position.head<2>();
  } catch (const TransformError&) {
    return std::nullopt;
  }
}

void PlanningServer::checkClock() {
  if (!clock_.jumpedBack()) return;
  ROS_WARN("ROS time jumped back: transforms and start poses from before are forgotten");
  transforms_.clear();
  on_time_jump_();
}

void PlanningServer::stop() {
  maps_.shutdown();
  worker_.stop();
}

void PlanningServer::publish(const Plan& plan, const PlanStatistics& statistics) {
  if (plan.found())
    ROS_INFO_STREAM("FOUND: " << plan.message);
  else
    ROS_WARN_STREAM(toString(plan.status) << ": " << plan.message);
  const double resolution =
      planner_.hasMap() ? planner_.map()->geometry().resolution() * plan.kernel : 1.0;
  publisher_.publishSearch(plan, statistics, resolution);
  if (plan.found()) writeWaypoints(plan.path);
  std::lock_guard<std::mutex> lock(mutex_);
  outcome_ = Outcome{plan.status, plan.message};
  if (plan.found()) last_path_ = plan.path;
}

void PlanningServer::writeWaypoints(const Path& path) {
  const std::string file = settings().options.waypoints_file;
  if (file.empty()) return;
  try {
    writeWaypointFile(files_.toWrite("waypoints_file", file, waypointFiles()), path);
  } catch (const InputError& error) {
    ROS_ERROR_STREAM("The waypoints were not saved: " << error.what());
  }
}

std::optional<PlanningServer::Outcome> PlanningServer::lastOutcome() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return outcome_;
}

std::optional<Path> PlanningServer::lastPath() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return last_path_;
}

}  // namespace grid_path_planner::nodes
