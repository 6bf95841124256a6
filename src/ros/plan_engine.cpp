#include "grid_path_planner/ros/plan_engine.h"

#include <algorithm>
#include <utility>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/planners/catalogue.h"
#include "grid_path_planner/ros/clock.h"
#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner {
namespace {

PlanReport failure(Status status, const std::string& message) {
  PlanReport report;
  report.status = status;
  report.message = message;
  return report;
}

PlannerOptions optionsFor(const PlanQuestion& question, PlannerOptions options) {
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

PlanAnswer PlanEngine::answer(const PlanQuestion& question, const PathPlannerNodeOptions& options,
                              const StopSource& stop, const PhaseListener& on_phase) {
  PlanAnswer answer;
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

PlanReport PlanEngine::report(const PlanQuestion& question, const PathPlannerNodeOptions& options,
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

PoseRequest PlanEngine::resolve(const PlanQuestion& question, const PathPlannerNodeOptions& options,
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

void PlanEngine::takeMap() {
  const std::optional<MapChange> change = maps_.take();
  if (!change) return;
  map_frame_id_ = change->map.frame_id;
  if (!change->changed || !planner_.hasMap())
    planner_.setMap(change->map.grid);
  else if (!change->changed->empty())
    planner_.updateMap(change->map.grid, *change->changed);
}

std::shared_ptr<const CostGrid> PlanEngine::searchedCosts(const PathPlannerNodeOptions& options,
                                                          const StopToken& stop) {
  takeMap();
  planner_.setOptions(options.planner);
  return planner_.hasMap() ? planner_.searchedCosts(stop) : nullptr;
}

std::shared_ptr<const CostGrid> PlanEngine::fineCosts(const PathPlannerNodeOptions& options,
                                                      const StopToken& stop) {
  takeMap();
  planner_.setOptions(options.planner);
  return planner_.hasMap() ? planner_.fineCosts(stop) : nullptr;
}

std::string PlanEngine::frame(const PathPlannerNodeOptions& options) const {
  return map_frame_id_.empty() ? frameName(options.map_frame) : map_frame_id_;
}

std::optional<Eigen::Vector2d> PlanEngine::vehicle(const PathPlannerNodeOptions& options) const {
  try {
    return transforms_.poseOf(options.base_frame, frame(options), 0.0, StopToken())
        .position.head<2>();
  } catch (const TransformError&) {
    return std::nullopt;
  }
}

}  // namespace grid_path_planner
