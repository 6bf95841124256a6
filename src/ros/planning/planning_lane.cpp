#include "ros/planning/planning_lane.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

#include "base/current_error.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/planning/replan_policy.h"
#include "grid_path_planner/ros/conversions.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "planning/map_store.h"
#include "ros/guard/clock.h"
#include "ros/guard/guarded_queue.h"
#include "ros/planning/plan_publisher.h"
#include "ros/planning/requests/request_poses.h"

namespace grid_path_planner::nodes {

using base::currentErrorText;
using base::InputError;
using base::Status;
using base::Stopped;
using base::StopSource;
using base::StopToken;
using base::TaskQueue;
using costmap::CostGrid;
using grid::OccupancyThresholds;
using path::Path;
using planners::memoryLimitOf;
using planning::explainFailure;
using planning::Explanation;
using planning::failedPlan;
using planning::MapStore;
using planning::PathPlanner;
using planning::Plan;
using planning::PlannerOptions;
using planning::planThrough;
using planning::remainingPath;
using planning::ViaPlan;
using planning::ViaRequest;

PlanningLane::PlanningLane(const MapReceiver& maps, std::shared_ptr<MapStore> store,
                           const FrameTransforms& transforms, const PlanningLane* other)
    : maps_(maps),
      store_(std::move(store)),
      transforms_(transforms),
      other_(other),
      worker_([](const std::string& error) { tellGivenUp("What follows a map", error); }) {}

void PlanningLane::prepare(const PathPlannerNodeOptions& options, const StopToken& stop) {
  takeMap();
  setOptions(options.planner);
  if (!planner_->hasMap()) return;
  try {
    planner_->prepare(stop);
    bytes_ = planner_->bytesOfSearches();
  } catch (const InputError&) {
    // There is too little memory: whoever asks for a path is told.
  }
}

void PlanningLane::finishLater(const PathPlannerNodeOptions& options) {
  worker_.postIdle([this, options](const StopSource& stop) {
    if (!planner_ || !planner_->hasMap()) return;
    const std::size_t cells = planner_->map()->geometry().size();
    try {
      setOptions(options.planner);
      if (cells <= kMostCopied) planner_->makeReadyForChanges(stop.token());
      if (cells <= kMostFinished) planner_->finishPreparation(stop.token());
    } catch (const Stopped&) {
    } catch (const InputError&) {
    }
  });
}

ViaPlan PlanningLane::plan(const PlanningRequest& request, const PathPlannerNodeOptions& options,
                           const StopSource& stop, const PhaseListener& on_phase,
                           std::uint64_t at_least) {
  ViaPlan answer = tryToPlan(request, options, stop, on_phase, at_least);
  Plan& plan = answer.plan;
  plan.path.frame_id = plan.waypoints.frame_id = frame(options);
  if (!plan.found()) plan.path.poses.clear();
  const MapData data = maps_.latest().data;
  if (plan.found() && data.problem(Instant::now(), 0.0, options.map_data_timeout))
    plan.message += "; the newest data in the map is older than map_data_timeout";
  return answer;
}

ViaPlan PlanningLane::tryToPlan(const PlanningRequest& request,
                                const PathPlannerNodeOptions& options, const StopSource& stop,
                                const PhaseListener& on_phase, std::uint64_t at_least) {
  const auto failed = [](Status status, const std::string& message) {
    ViaPlan answer;
    answer.plan = failedPlan(status, message);
    return answer;
  };
  question_.reset();
  try {
    checkText(request);
    waitForClock(stop.token());
    if (on_phase) on_phase("preparing");
    takeMap(at_least);
    setOptions(optionsFor(request, options));
    if (!planner_->hasMap())
      return failed(Status::NO_MAP, "no map has come on " + maps_.topic() + " yet");
    ViaRequest poses = posesOf(request, options, transforms_, frame(options), stop.token());
    poses.record_expanded = options.record_search;
    question_ = PlanQuestion{poses, planner_->options(), options.pose_spacing};
    if (on_phase) on_phase("searching");
    ViaPlan answer = planThrough(*planner_, poses, stop);
    bytes_ = planner_->bytesOfSearches();
    return answer;
  } catch (const InputError& error) {
    return failed(Status::INVALID_REQUEST, error.what());
  } catch (const TransformError& error) {
    return failed(Status::TRANSFORM_ERROR, error.what());
  } catch (const Stopped& stopped) {
    return failed(stopped.status(), stopped.status() == Status::TIMEOUT
                                        ? "planning reached its time limit"
                                        : "planning was cancelled");
  } catch (...) {
    return failed(Status::INVALID_REQUEST, "the request was given up: " + currentErrorText());
  }
}

Explanation PlanningLane::explain(const PlanningRequest& request, Status status,
                                  const PathPlannerNodeOptions& options, const StopSource& stop,
                                  std::chrono::duration<double> limit) {
  if (status != Status::UNREACHABLE && status != Status::GOAL_OCCUPIED) return {};
  if (!request.via_points.empty()) return {};
  try {
    takeMap();
    setOptions(optionsFor(request, options));
    const ViaRequest poses = posesOf(request, options, transforms_, frame(options), stop.token());
    return explainFailure(*planner_, {poses.start, poses.goal, false}, status, stop.token(limit));
  } catch (const InputError&) {
  } catch (const TransformError&) {
  } catch (const Stopped&) {
  }
  return {};
}

PlanStatistics PlanningLane::statistics(const Plan& plan, const PlanningRequest& request,
                                        const PathPlannerNodeOptions& options) {
  PlanStatistics message = statisticsMessage(plan);
  const PlanningRequest asked = printable(request);
  message.goal = asked.goal;
  if (!request.closed && request.goal.header.frame_id.empty())
    message.goal.header.frame_id = frameName(options.map_frame);
  message.planner = plannerOf(asked, options);
  message.heuristic = heuristicOf(asked, options);
  message.answered_by = plan.answered_by;
  if (plan.found())
    message.clearance_m = clearanceOf(plan.path, options.planner.costmap.thresholds);
  return message;
}

double PlanningLane::clearanceOf(const Path& path, const OccupancyThresholds& thresholds) {
  auto meter = std::move(clearances_);  // what an error leaves half done is gone
  if (!meter || !meter->isOf(planner_->map(), thresholds))
    meter = std::make_unique<path::ClearanceMeter>(planner_->map(), thresholds);
  const double clearance = meter->clearanceOf(path);
  clearances_ = std::move(meter);
  return clearance;
}

Path PlanningLane::posesAlong(const Plan& plan, const PathPlannerNodeOptions& options) const {
  if (!plan.found()) return plan.path;
  return nodes::posesAlong(plan, *planner_->map(), options.pose_spacing, options.planner.heading);
}

std::optional<PlanRecord> PlanningLane::record(const Plan& plan,
                                               const PathPlannerNodeOptions& options) const {
  const bool searched = question_ && planner_ && planner_->hasMap();
  if (!searched || plan.status == Status::CANCELLED) return std::nullopt;
  return recordOf(*question_, *planner_->map(), plan, posesAlong(plan, options));
}

double PlanningLane::cellSize(const Plan& plan) const {
  const bool has_map = planner_ && planner_->hasMap();
  return has_map ? planner_->map()->geometry().resolution() * plan.kernel : 1.0;
}

double PlanningLane::mapSide() const {
  if (!planner_ || !planner_->hasMap()) return 0.0;
  const auto& geometry = planner_->map()->geometry();
  return geometry.resolution() * std::max(geometry.width(), geometry.height());
}

void PlanningLane::takeMap(std::uint64_t at_least) {
  if (!planner_) planner_ = std::make_unique<PathPlanner>(store_);
  planner_->takeMap(at_least);
  if (clearances_ && !clearances_->isOfMap(planner_->map())) clearances_.reset();
  bytes_ = planner_->bytesOfSearches();
}

void PlanningLane::setOptions(const PlannerOptions& options) {
  planner_->setOptions(options);
  const std::size_t limit = memoryLimitOf(options.search);
  planner_->limitMemory(limit - std::min(limit, other_ ? other_->bytes_.load() : 0));
}

std::shared_ptr<const CostGrid> PlanningLane::downsampledCosts(
    const PathPlannerNodeOptions& options, const StopToken& stop) {
  takeMap();
  setOptions(options.planner);
  auto costs = planner_->hasMap() ? planner_->downsampledCosts(stop) : nullptr;
  bytes_ = planner_->bytesOfSearches();
  return costs;
}

std::shared_ptr<const CostGrid> PlanningLane::fullResolutionCosts(
    const PathPlannerNodeOptions& options, const StopToken& stop) {
  takeMap();
  setOptions(options.planner);
  return planner_->hasMap() ? planner_->fullResolutionCosts(stop) : nullptr;
}

// The segment that the vehicle is on counts from where it begins, with the heading there.
std::string PlanningLane::footprintContact(const Path& path,
                                           const std::optional<Eigen::Vector2d>& position,
                                           const PathPlannerNodeOptions& options,
                                           const StopToken& stop) {
  takeMap();
  setOptions(options.planner);
  if (!planner_->hasMap() || path.empty()) return "";
  Path ahead = path;
  if (position) {
    const std::size_t corners = remainingPath(path, *position).size() - 2;
    ahead.poses.assign(path.poses.end() - static_cast<std::ptrdiff_t>(corners) - 1,
                       path.poses.end());
  }
  return planner_->footprintContact(ahead, std::nullopt, stop);
}

Eigen::Vector2d PlanningLane::goalOf(const PlanningRequest& request,
                                     const PathPlannerNodeOptions& options,
                                     const StopToken& stop) const {
  return transforms_.place(request.goal, placingInMap(options, frame(options), stop))
      .position.head<2>();
}

std::optional<geometry_msgs::PoseStamped> PlanningLane::placedGoal(
    const PlanningRequest& request, const PathPlannerNodeOptions& options) const {
  const std::string named = frameInMap(request.goal.header.frame_id, options.map_frame);
  if (!question_ || !transforms_.movesWith(frameName(options.base_frame), named))
    return std::nullopt;
  geometry_msgs::PoseStamped placed;
  placed.header.frame_id = frame(options);
  placed.pose = poseToMessage(question_->request.goal);
  if (question_->request.any_goal_heading) placed.pose.orientation = {};
  return placed;
}

std::string PlanningLane::frame(const PathPlannerNodeOptions& options) const {
  return frameInMap(planner_ ? planner_->frameId() : std::string(), options.map_frame);
}

}  // namespace grid_path_planner::nodes
