#include "grid_path_planner/planning/path_planner.h"

#include <cassert>
#include <chrono>
#include <cmath>
#include <sstream>
#include <utility>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "grid_path_planner/planning/multi_resolution_planner.h"
#include "planning/plan_attempt.h"

namespace grid_path_planner::planning {

using base::checkOptionLimits;
using base::choiceName;
using base::InputError;
using base::sameOptions;
using base::Status;
using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::checkCostmapOptions;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::CostmapBuilder;
using costmap::DiagonalCost;
using costmap::MotionModel;
using grid::CellRect;
using grid::checkOccupancyValues;
using grid::OccupancyGrid;
using path::Pose;
using planners::checkSearchOptions;
using planners::PlannerMaker;
using planners::TooExpensive;

namespace {

bool finite(const Pose& pose) {
  return pose.position.allFinite() && std::isfinite(pose.yaw);
}

Plan failure(Status status, const std::string& message) {
  Plan report;
  report.status = status;
  report.message = message;
  return report;
}

std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

StopToken limited(const StopSource& stop, double timeout) {
  return timeout > 0.0 ? stop.token(std::chrono::duration<double>(timeout)) : stop.token();
}

}  // namespace

void checkPlannerOptions(const PlannerOptions& options, const PlannerMaker& make_planner) {
  checkOptionLimits(options);
  checkCostmapOptions(options.terrain);
  checkSearchOptions(options.search);
  make_planner(options.planner, options.search);
  const MotionModel& motion = options.terrain.motion;
  if (options.smooth &&
      (motion.connectivity != Connectivity::EIGHT || motion.diagonal_cost != DiagonalCost::SQRT2))
    throw InputError("smooth needs connectivity 8 and diagonal_cost sqrt2, got connectivity " +
                     std::string(choiceName(motion.connectivity)) + " and diagonal_cost " +
                     choiceName(motion.diagonal_cost));
}

PathPlanner::PathPlanner(const PlannerOptions& options, PlannerMaker make_planner)
    : make_planner_(std::move(make_planner)) {
  setOptions(options);
}
PathPlanner::~PathPlanner() = default;
PathPlanner::PathPlanner(PathPlanner&&) noexcept = default;
PathPlanner& PathPlanner::operator=(PathPlanner&&) noexcept = default;

void PathPlanner::setOptions(const PlannerOptions& options) {
  checkPlannerOptions(options, make_planner_);
  const bool new_terrain = !terrain_ || !sameOptions(options.terrain, options_.terrain);
  const bool new_routes = new_terrain || options.planner != options_.planner ||
                          !sameOptions(options.search, options_.search);
  if (new_routes)
    routes_ =
        std::make_unique<MultiResolutionPlanner>(options.planner, options.search, make_planner_);
  if (new_terrain) {
    terrain_ = std::make_unique<CostmapBuilder>(options.terrain);
    if (map_) terrain_->setMap(map_);
  }
  options_ = options;
}

void PathPlanner::setMap(std::shared_ptr<const OccupancyGrid> map) {
  if (map->geometry().size() == 0) throw InputError("a map needs at least one cell, got 0x0");
  checkOccupancyValues(*map);
  map_ = std::move(map);
  terrain_->setMap(map_);
}

void PathPlanner::updateMap(std::shared_ptr<const OccupancyGrid> map, const CellRect& changed) {
  if (!map_ || map->geometry() != map_->geometry()) return setMap(std::move(map));
  checkOccupancyValues(*map, changed);
  map_ = std::move(map);
  terrain_->updateMap(map_, changed);
}

std::shared_ptr<const CostGrid> PathPlanner::fullResolutionCosts(const StopToken& stop) {
  return followedMaps(stop).full_resolution;
}

std::shared_ptr<const CostGrid> PathPlanner::downsampledCosts(const StopToken& stop) {
  return followedMaps(stop).downsampled;
}

CostmapPair PathPlanner::maps(const StopToken& stop) {
  assert(hasMap());
  const auto searched = terrain_->downsampled(stop);
  return {terrain_->fullResolution(stop), searched, terrain_->fullResolutionChange(),
          terrain_->downsampledChange()};
}

CostmapPair PathPlanner::followedMaps(const StopToken& stop) {
  CostmapPair all = maps(stop);
  routes_->follow(all, stop);
  return all;
}

void PathPlanner::finishPreparation(const StopToken& stop) {
  routes_->prepare(maps(stop), stop);
  routes_->finishBackgroundWork(stop);
}

Plan PathPlanner::plan(const PoseRequest& request, const StopSource& stop) {
  if (!hasMap()) return failure(Status::NO_MAP, "no map has arrived yet");
  if (!finite(request.start) || !finite(request.goal))
    return failure(Status::INVALID_REQUEST, "start and goal must be finite numbers");
  Plan report;
  try {
    const StopToken token = limited(stop, options_.timeout);
    const auto begin = StopToken::Clock::now();
    routes_->prepare(maps(token), token);
    const auto prepared = StopToken::Clock::now();
    report = PlanAttempt(*this, request, token).run();
    report.preparation_time_s = std::chrono::duration<double>(prepared - begin).count();
  } catch (const Stopped& stopped) {
    report = failure(stopped.status(), "");
  } catch (const TooExpensive&) {
    report = failure(Status::INVALID_REQUEST, TooExpensive::kMessage);
  }
  if (report.status == Status::TIMEOUT)
    report.message = "planning reached its time limit of " + number(options_.timeout) + " s";
  if (report.status == Status::CANCELLED) report.message = "planning was cancelled";
  report.path.frame_id = "map";
  return report;
}

}  // namespace grid_path_planner::planning
