#include "ros/planning/planning_backend.h"

#include <algorithm>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/common/clock.h"

namespace grid_path_planner::nodes {

using base::choiceFromName;
using base::choiceName;
using base::InputError;
using base::Status;
using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::CostGrid;
using path::clearanceOf;
using path::Pose;
using path::turningOf;
using planners::Heuristic;
using planners::makePlanner;
using planners::plannerNames;
using planning::Plan;
using planning::PlannerOptions;
using planning::PoseRequest;

namespace {

Plan failure(Status status, const std::string& message) {
  Plan report;
  report.status = status;
  report.message = message;
  return report;
}

PlannerOptions optionsFor(const PlanningRequest& question, PlannerOptions options) {
  if (!question.planner.empty()) options.planner = question.planner;
  if (!question.heuristic.empty())
    options.search.heuristic = choiceFromName<Heuristic>("heuristic", question.heuristic);
  if (question.tolerance) options.tolerance = *question.tolerance;
  return options;
}

Pose named(const char* which, const std::function<Pose()>& pose) {
  try {
    return pose();
  } catch (const InputError& error) {
    throw InputError(std::string("the ") + which + ": " + error.what());
  }
}

}  // namespace

bool usesHeuristic(const std::string& planner) {
  const std::vector<std::string>& known = plannerNames();
  const bool exists = std::find(known.begin(), known.end(), planner) != known.end();
  return exists && makePlanner(planner)->traits().heuristic;
}

PlanningResult PlanningBackend::answer(const PlanningRequest& question,
                                       const PathPlannerNodeOptions& options,
                                       const StopSource& stop, const PhaseListener& on_phase) {
  PlanningResult answer;
  answer.planner = question.planner.empty() ? options.planner.planner : question.planner;
  if (usesHeuristic(answer.planner))
    answer.heuristic = question.heuristic.empty() ? choiceName(options.planner.search.heuristic)
                                                  : question.heuristic;
  try {
    answer.report = report(question, options, stop, on_phase);
  } catch (const InputError& error) {
    answer.report = failure(Status::INVALID_REQUEST, error.what());
  } catch (const TransformError& error) {
    answer.report = failure(Status::TRANSFORM_ERROR, error.what());
  } catch (const Stopped& stopped) {
    answer.report = failure(stopped.status(), stopped.status() == Status::TIMEOUT
                                                  ? "planning reached its time limit"
                                                  : "planning was cancelled");
  }
  answer.report.path.frame_id = frame(options);
  if (!answer.found()) answer.report.path.poses.clear();
  if (answer.found()) {
    answer.turning_rad = turningOf(answer.report.path);
    answer.clearance_m =
        clearanceOf(answer.report.path, *planner_.map(), options.planner.terrain.thresholds);
  }
  return answer;
}

Plan PlanningBackend::report(const PlanningRequest& question, const PathPlannerNodeOptions& options,
                             const StopSource& stop, const PhaseListener& on_phase) {
  waitForClock(stop.token());
  if (on_phase) on_phase(Phase::PREPARING);
  takeMap();
  planner_.setOptions(optionsFor(question, options.planner));
  if (!planner_.hasMap())
    return failure(Status::NO_MAP, "no map has come on " + maps_.topic() + " yet");
  PoseRequest request = resolve(question, options, stop.token());
  request.record_expanded = options.record_search;
  if (on_phase) on_phase(Phase::SEARCHING);
  return planner_.plan(request, stop);
}

PoseRequest PlanningBackend::resolve(const PlanningRequest& question,
                                     const PathPlannerNodeOptions& options,
                                     const StopToken& stop) const {
  const std::string map_frame = frame(options);
  PoseRequest request;
  request.goal = named("goal", [&] {
    return transforms_.poseIn(map_frame, question.goal, options.tf_timeout, stop);
  });
  request.start = named("start", [&] {
    return question.start
               ? transforms_.poseIn(map_frame, *question.start, options.tf_timeout, stop)
               : transforms_.poseOf(options.base_frame, map_frame, options.tf_timeout, stop);
  });
  if (options.goal_z_from == GoalZ::VEHICLE) request.goal.position.z() = request.start.position.z();
  return request;
}

void PlanningBackend::takeMap() {
  const std::optional<MapChange> change = maps_.take();
  if (!change) return;
  map_frame_id_ = change->map.frame_id;
  if (!change->changed || !planner_.hasMap())
    planner_.setMap(change->map.grid);
  else if (!change->changed->empty())
    planner_.updateMap(change->map.grid, *change->changed);
}

std::shared_ptr<const CostGrid> PlanningBackend::searchedCosts(
    const PathPlannerNodeOptions& options, const StopToken& stop) {
  takeMap();
  planner_.setOptions(options.planner);
  return planner_.hasMap() ? planner_.downsampledCosts(stop) : nullptr;
}

std::shared_ptr<const CostGrid> PlanningBackend::fineCosts(const PathPlannerNodeOptions& options,
                                                           const StopToken& stop) {
  takeMap();
  planner_.setOptions(options.planner);
  return planner_.hasMap() ? planner_.fullResolutionCosts(stop) : nullptr;
}

std::string PlanningBackend::frame(const PathPlannerNodeOptions& options) const {
  return map_frame_id_.empty() ? frameName(options.map_frame) : map_frame_id_;
}

std::optional<Eigen::Vector2d> PlanningBackend::vehicle(
    const PathPlannerNodeOptions& options) const {
  try {
    return transforms_.poseOf(options.base_frame, frame(options), 0.0, StopToken())
        .position.head<2>();
  } catch (const TransformError&) {
    return std::nullopt;
  }
}

}  // namespace grid_path_planner::nodes
