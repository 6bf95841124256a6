#include "grid_path_planner/planners/map_planner.h"

#include <cassert>
#include <chrono>
#include <cmath>
#include <sstream>
#include <utility>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/planners/catalogue.h"
#include "grid_path_planner/planners/plan_attempt.h"
#include "grid_path_planner/planners/route.h"
#include "grid_path_planner/terrain/terrain.h"

namespace grid_path_planner {
namespace {

bool finite(const Pose& pose) {
  return pose.position.allFinite() && std::isfinite(pose.yaw);
}

PlanReport failure(Status status, const std::string& message) {
  PlanReport report;
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
  checkTerrainOptions(options.terrain);
  checkSearchOptions(options.search);
  make_planner(options.planner, options.search);
  const MotionModel& motion = options.terrain.motion;
  if (options.smooth &&
      (motion.connectivity != Connectivity::EIGHT || motion.diagonal_cost != DiagonalCost::SQRT2))
    throw InputError("smooth needs connectivity 8 and diagonal_cost sqrt2, got connectivity " +
                     std::string(choiceName(motion.connectivity)) + " and diagonal_cost " +
                     choiceName(motion.diagonal_cost));
}

MapPlanner::MapPlanner(const PlannerOptions& options, PlannerMaker make_planner)
    : make_planner_(std::move(make_planner)) {
  setOptions(options);
}
MapPlanner::~MapPlanner() = default;
MapPlanner::MapPlanner(MapPlanner&&) noexcept = default;
MapPlanner& MapPlanner::operator=(MapPlanner&&) noexcept = default;

void MapPlanner::setOptions(const PlannerOptions& options) {
  checkPlannerOptions(options, make_planner_);
  const bool new_terrain = !terrain_ || !sameOptions(options.terrain, options_.terrain);
  const bool new_routes = new_terrain || options.planner != options_.planner ||
                          !sameOptions(options.search, options_.search);
  if (new_routes)
    routes_ = std::make_unique<RouteFinder>(options.planner, options.search, make_planner_);
  if (new_terrain) {
    terrain_ = std::make_unique<Terrain>(options.terrain);
    if (map_) terrain_->setMap(map_);
  }
  options_ = options;
}

void MapPlanner::setMap(std::shared_ptr<const OccupancyGrid> map) {
  if (map->geometry().size() == 0) throw InputError("a map needs at least one cell, got 0x0");
  checkOccupancyValues(*map);
  map_ = std::move(map);
  terrain_->setMap(map_);
}

void MapPlanner::updateMap(std::shared_ptr<const OccupancyGrid> map, const CellRect& changed) {
  if (!map_ || map->geometry() != map_->geometry()) return setMap(std::move(map));
  checkOccupancyValues(*map, changed);
  map_ = std::move(map);
  terrain_->updateMap(map_, changed);
}

std::shared_ptr<const CostGrid> MapPlanner::fineCosts(const StopToken& stop) {
  return followedMaps(stop).fine;
}

std::shared_ptr<const CostGrid> MapPlanner::searchedCosts(const StopToken& stop) {
  return followedMaps(stop).searched;
}

RouteMaps MapPlanner::maps(const StopToken& stop) {
  assert(hasMap());
  const auto searched = terrain_->searched(stop);
  return {terrain_->fine(stop), searched, terrain_->fineChange(), terrain_->searchedChange()};
}

RouteMaps MapPlanner::followedMaps(const StopToken& stop) {
  RouteMaps all = maps(stop);
  routes_->follow(all, stop);
  return all;
}

void MapPlanner::finishPreparation(const StopToken& stop) {
  routes_->prepare(maps(stop), stop);
  routes_->finishBackgroundWork(stop);
}

PlanReport MapPlanner::plan(const PoseRequest& request, const StopSource& stop) {
  if (!hasMap()) return failure(Status::NO_MAP, "no map has arrived yet");
  if (!finite(request.start) || !finite(request.goal))
    return failure(Status::INVALID_REQUEST, "start and goal must be finite numbers");
  PlanReport report;
  try {
    const StopToken token = limited(stop, options_.timeout);
    const auto begin = StopToken::Clock::now();
    routes_->prepare(maps(token), token);
    const auto prepared = StopToken::Clock::now();
    report = PlanAttempt(*this, request, token).run();
    report.preparation_time_s = std::chrono::duration<double>(prepared - begin).count();
  } catch (const Stopped& stopped) {
    report = failure(stopped.status(), "");
  } catch (const CostOverflow&) {
    report = failure(Status::INVALID_REQUEST,
                     "a path may cost more than 4.4e9 cell lengths x weight: use smaller weights");
  }
  if (report.status == Status::TIMEOUT)
    report.message = "planning reached its time limit of " + number(options_.timeout) + " s";
  if (report.status == Status::CANCELLED) report.message = "planning was cancelled";
  report.path.frame_id = "map";
  return report;
}

}  // namespace grid_path_planner
