#include "grid_path_planner/planning/path_planner.h"

#include <cassert>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/path/metrics.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "planning/message_text.h"
#include "planning/multi_resolution_planner.h"
#include "planning/path_ends.h"

namespace grid_path_planner::planning {

using base::checkOptionLimits, base::choiceName, base::InputError, base::sameOptions,
    base::Statistics, base::Status, base::Stopped, base::StopSource, base::StopToken;
using costmap::checkCostmapOptions, costmap::Connectivity, costmap::CostGrid,
    costmap::CostmapBuilder, costmap::DiagonalCost, costmap::MotionModel;
using grid::CellRect, grid::checkOccupancyValues, grid::OccupancyGrid;
using path::applyHeadings, path::applyZ, path::lengthOf, path::Path, path::Pose;
using planners::checkSearchOptions, planners::PlannerMaker, planners::TooExpensive,
    planners::traitsOf;

namespace {

bool finite(const Pose& pose) {
  return pose.position.allFinite() && std::isfinite(pose.yaw);
}

bool samePose(const Pose& a, const Pose& b) {
  const double turn = std::remainder(a.yaw - b.yaw, 2.0 * M_PI);
  return (a.position - b.position).norm() < 1e-9 && std::abs(turn) < 1e-9;
}

void addNote(std::string& message, const std::string& note) {
  if (!note.empty()) message += "; " + note;
}

std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

StopToken limited(const StopSource& stop, double timeout) {
  return timeout > 0.0 ? stop.token(std::chrono::duration<double>(timeout)) : stop.token();
}

// All but the planner's name, whose check is left to what makes the planner.
void checkOtherOptions(const PlannerOptions& options) {
  checkOptionLimits(options);
  checkCostmapOptions(options.costmap);
  checkSearchOptions(options.search);
  const MotionModel& motion = options.costmap.motion;
  if (options.smooth &&
      (motion.connectivity != Connectivity::EIGHT || motion.diagonal_cost != DiagonalCost::SQRT2))
    throw InputError("smooth needs connectivity 8 and diagonal_cost sqrt2, got connectivity " +
                     std::string(choiceName(motion.connectivity)) + " and diagonal_cost " +
                     choiceName(motion.diagonal_cost));
}

Path pathOf(const Route& route, const PathEnd& start, const PathEnd& goal,
            const PoseRequest& request, const PlannerOptions& options) {
  Path path;
  if (!goal.moved && !start.moved && samePose(request.start, request.goal)) {
    path.poses.push_back(request.goal);
    return path;
  }
  path = pathOfRoute(route, start.position, goal.position, start.moved);
  applyZ(path, request.start.position.z(), request.goal.position.z(), options.fixed_z,
         options.path_z);
  applyHeadings(path, request.start.yaw, request.goal.yaw, options.heading);
  return path;
}

// "a path of 12.3 m, cost 45.6" and the notes.
std::string foundMessage(const Plan& plan, const PathEnd& start, const PathEnd& goal) {
  std::ostringstream text;
  text << "a path of " << metresText(plan.length_m) << ", cost " << std::setprecision(10)
       << plan.costValue();
  std::string message = text.str();
  addNote(message, plan.message);
  addNote(message, start.note);
  addNote(message, goal.note);
  return message;
}

std::string unreachableMessage(const PathEnd& start, const PathEnd& goal, double tolerance) {
  std::string message =
      "no path leads from " + positionText(start.position) + " to " + positionText(goal.position);
  if (tolerance > 0.0) message += " or within " + metresText(tolerance) + " of it";
  return message;
}

Plan completedPlan(Route route, const PathEnd& start, const PathEnd& goal,
                   const PoseRequest& request, const PlannerOptions& options) {
  Plan plan = std::move(route.plan);
  if (plan.status == Status::UNREACHABLE)
    plan.message = unreachableMessage(start, goal, options.tolerance);
  if (!plan.found()) {
    plan.cost = {};
    plan.segment_cost = 0.0;
    return plan;
  }
  for (const Leg& leg : route.legs) plan.cells += leg.result.cells.size();
  plan.cells -= route.legs.size() - 1;
  plan.path = pathOf(route, start, goal, request, options);
  plan.length_m = lengthOf(plan.path);
  plan.message = foundMessage(plan, start, goal);
  return plan;
}

}  // namespace

void checkPlannerOptions(const PlannerOptions& options) {
  checkOtherOptions(options);
  traitsOf(options.planner);
}

PathPlanner::PathPlanner(const PlannerOptions& options, PlannerMaker make_planner)
    : make_planner_(std::move(make_planner)) {
  setOptions(options);
}
PathPlanner::~PathPlanner() = default;
PathPlanner::PathPlanner(PathPlanner&&) noexcept = default;
PathPlanner& PathPlanner::operator=(PathPlanner&&) noexcept = default;

void PathPlanner::setOptions(const PlannerOptions& options) {
  checkOtherOptions(options);
  const bool new_costmap = !costmap_ || !sameOptions(options.costmap, options_.costmap);
  const bool new_search = new_costmap || options.planner != options_.planner ||
                          !sameOptions(options.search, options_.search);
  if (new_search)
    search_ =
        std::make_unique<MultiResolutionPlanner>(options.planner, options.search, make_planner_);
  if (new_costmap) {
    costmap_ = std::make_unique<CostmapBuilder>(options.costmap);
    if (map_) costmap_->setMap(map_);
  }
  options_ = options;
}

void PathPlanner::setMap(std::shared_ptr<const OccupancyGrid> map) {
  if (map->geometry().size() == 0) throw InputError("a map needs at least one cell, got 0x0");
  checkOccupancyValues(*map);
  map_ = std::move(map);
  costmap_->setMap(map_);
}

void PathPlanner::updateMap(std::shared_ptr<const OccupancyGrid> map, const CellRect& changed) {
  if (!map_ || map->geometry() != map_->geometry()) return setMap(std::move(map));
  checkOccupancyValues(*map, changed);
  map_ = std::move(map);
  costmap_->updateMap(map_, changed);
}

std::shared_ptr<const CostGrid> PathPlanner::fullResolutionCosts(const StopToken& stop) {
  return followedCostmaps(stop).full_resolution;
}

std::shared_ptr<const CostGrid> PathPlanner::downsampledCosts(const StopToken& stop) {
  return followedCostmaps(stop).downsampled;
}

CostmapPair PathPlanner::costmaps(const StopToken& stop) {
  assert(hasMap());
  const auto downsampled = costmap_->downsampled(stop);
  return {costmap_->fullResolution(stop), downsampled, costmap_->fullResolutionChange(),
          costmap_->downsampledChange()};
}

CostmapPair PathPlanner::followedCostmaps(const StopToken& stop) {
  CostmapPair maps = costmaps(stop);
  search_->follow(maps, stop);
  return maps;
}

void PathPlanner::finishPreparation(const StopToken& stop) {
  search_->prepare(costmaps(stop), stop);
  search_->finishBackgroundWork(stop);
}

Plan PathPlanner::plan(const PoseRequest& request, const StopSource& stop) {
  if (!hasMap()) return failedPlan(Status::NO_MAP, "no map has arrived yet");
  if (!finite(request.start) || !finite(request.goal))
    return failedPlan(Status::INVALID_REQUEST, "start and goal must be finite numbers");
  Plan plan;
  try {
    const StopToken token = limited(stop, options_.timeout);
    const auto begin = StopToken::Clock::now();
    const CostmapPair maps = costmaps(token);
    search_->prepare(maps, token);
    const auto prepared = StopToken::Clock::now();
    plan = planOn(*maps.full_resolution, request, token);
    plan.preparation_time_s = std::chrono::duration<double>(prepared - begin).count();
  } catch (const Stopped& stopped) {
    plan = failedPlan(stopped.status(), "");
  } catch (const TooExpensive&) {
    plan = failedPlan(Status::INVALID_REQUEST, TooExpensive::kMessage);
  }
  if (plan.status == Status::TIMEOUT)
    plan.message = "planning reached its time limit of " + number(options_.timeout) + " s";
  if (plan.status == Status::CANCELLED) plan.message = "planning was cancelled";
  plan.path.frame_id = "map";
  return plan;
}

Plan PathPlanner::planOn(const CostGrid& costs, const PoseRequest& request, const StopToken& stop) {
  const PathEnds ends(request, options_, costs, *search_, stop);
  Plan failure;
  std::optional<PathEnd> start = ends.start(failure);
  if (!start) return failure;
  std::optional<PathEnd> goal = ends.goal(*start, failure);
  if (!goal) return failure;

  Route route = search(*start, *goal, request.record_expanded, stop);
  const auto searchAgain = [&] {
    const Statistics before = route.plan.statistics;
    route = search(*start, *goal, request.record_expanded, stop);
    route.plan.statistics += before;
  };
  if (route.plan.status == Status::UNREACHABLE && start->moved && !goal->moved) {
    if (const std::optional<PathEnd> other = ends.escapeTowards(*goal)) {
      start = other;
      searchAgain();
    }
  }
  if (route.plan.status == Status::UNREACHABLE && !goal->moved && options_.tolerance > 0.0) {
    if (const std::optional<PathEnd> other = ends.substituteGoal(*start, "is unreachable")) {
      goal = other;
      searchAgain();
    }
  }
  return completedPlan(std::move(route), *start, *goal, request, options_);
}

Route PathPlanner::search(const PathEnd& start, const PathEnd& goal, bool record_expanded,
                          const StopToken& stop) {
  Route route = search_->find(start.cell, goal.cell, options_.retry_finer, record_expanded, stop);
  if (options_.smooth && route.plan.found()) smoothRoute(route, stop);
  return route;
}

}  // namespace grid_path_planner::planning
