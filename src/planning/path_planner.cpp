#include "grid_path_planner/planning/path_planner.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <sstream>
#include <type_traits>
#include <utility>

#include "base/rebuildable.h"
#include "grid/foreign_values.h"
#include "grid_path_planner/base/options.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "planning/footprint/fitted_plan.h"
#include "planning/map_store.h"
#include "planning/message_text.h"
#include "planning/multi_resolution_planner.h"
#include "planning/plan_on_costs.h"
#include "planning/prepared_planners.h"
#include "planning/turning/curves.h"
#include "vehicle/footprint.h"

namespace grid_path_planner::planning {

using base::checkOptionLimits, base::choiceName, base::InputError, base::sameOptions, base::Status,
    base::Stopped, base::StopSource, base::StopToken;
using costmap::checkCostmapOptions, costmap::CostGrid, costmap::CostmapBuilder,
    costmap::CostmapOptions;
using grid::CellRect, grid::checkOccupancyValues, grid::GridGeometry, grid::OccupancyGrid;
using path::HeadingMode;
using planners::checkSearchOptions, planners::memoryLimitOf, planners::PlannerMaker,
    planners::TooExpensive, planners::traitsOf;
using vehicle::Footprint;

namespace {

constexpr char kNoCells[] = "a map needs at least one cell, got 0x0";

void checkTurning(const PlannerOptions& options) {
  const bool along = options.heading == HeadingMode::FORWARD ||
                     options.heading == HeadingMode::BACKWARD ||
                     options.heading == HeadingMode::NONE;
  if (options.min_turning_radius > 0.0 && !along)
    throw InputError("min_turning_radius needs heading forward, backward or none, got heading " +
                     std::string(choiceName(options.heading)));
}

// All but the planner's name, whose check is left to what makes the planner.
Footprint checkOtherOptions(const PlannerOptions& options) {
  checkOptionLimits(options);
  checkCostmapOptions(options.costmap);
  checkSearchOptions(options.search);
  Footprint footprint = Footprint::fromText("footprint", options.footprint);
  if (options.costmap.occupied_is_passable && !footprint.empty())
    throw InputError("occupied_is_passable needs an empty footprint, got footprint " +
                     options.footprint);
  checkTurning(options);
  return footprint;
}

}  // namespace

// What throws these leaves the searches as they may be used.
struct PathPlanner::Searches
    : base::Rebuildable<PreparedPlanners, Stopped, InputError, TooExpensive> {
  explicit Searches(const PlannerMaker& make_planner)
      : Rebuildable([make_planner] { return PreparedPlanners(make_planner); }) {}

  void use(const PlannerOptions& options) {
    change([&](PreparedPlanners& all) { all.use(options.planner, options.search); });
  }
};

void checkPlannerOptions(const PlannerOptions& options) {
  checkOtherOptions(options);
  traitsOf(options.planner);
}

PathPlanner::PathPlanner(const PlannerOptions& options, PlannerMaker make_planner)
    : make_planner_(std::move(make_planner)), shared_(false), store_(std::make_shared<MapStore>()) {
  setOptions(options);
}

PathPlanner::PathPlanner(std::shared_ptr<MapStore> store, const PlannerOptions& options,
                         PlannerMaker make_planner)
    : make_planner_(std::move(make_planner)), shared_(true), store_(std::move(store)) {
  setOptions(options);
}

PathPlanner::~PathPlanner() = default;
PathPlanner::PathPlanner(PathPlanner&&) noexcept = default;
PathPlanner& PathPlanner::operator=(PathPlanner&&) noexcept = default;

// All that may fail comes first.
void PathPlanner::setOptions(const PlannerOptions& options) {
  static_assert(std::is_nothrow_move_assignable_v<PlannerOptions>);
  Footprint outline = checkOtherOptions(options);
  PlannerOptions given = options, searched = options;
  searched.costmap.radius = std::max(options.costmap.radius, outline.inscribedRadius());
  std::unique_ptr<const Footprint> footprint;
  if (!outline.empty()) footprint = std::make_unique<const Footprint>(std::move(outline));
  if (!searches_ || !sameOptions(searched.costmap, searched_.costmap))
    searchOn(series_, searched);
  else
    searches_->use(options);
  options_ = std::move(given);
  searched_ = std::move(searched);
  footprint_ = std::move(footprint);
}

void PathPlanner::searchOn(std::shared_ptr<MapSeries> series, const PlannerOptions& options) {
  auto searches = std::make_unique<Searches>(make_planner_);
  searches->use(options);
  costmap_ = series ? series->costmap(options.costmap) : nullptr;
  series_ = std::move(series);
  searches_ = std::move(searches);
}

void PathPlanner::setMap(std::shared_ptr<const OccupancyGrid> map) {
  if (map->geometry().size() == 0) throw InputError(kNoCells);
  checkOccupancyValues(*map);
  store_->setMap(std::move(map), "map");
  takeMap();
}

void PathPlanner::updateMap(std::shared_ptr<const OccupancyGrid> map,
                            const std::vector<CellRect>& changed) {
  if (!map_ || map->geometry() != map_->geometry()) return setMap(std::move(map));
  for (const CellRect& rect : changed) checkOccupancyValues(*map, rect);
  store_->updateMap(std::move(map), changed);
  takeMap();
}

void PathPlanner::takeMap(std::uint64_t at_least) {
  std::shared_ptr<MapSeries> series = store_->series();
  if (!series) return;
  if (series->geometry().size() == 0) throw InputError(kNoCells);
  std::shared_ptr<const OccupancyGrid> map = series->newest()->map;
  if (series != series_) searchOn(std::move(series), searched_);
  map_ = std::move(map);
  at_least_ = at_least;
}

const std::string& PathPlanner::frameId() const {
  static const std::string none;
  return series_ ? series_->frameId() : none;
}

std::shared_ptr<const CostGrid> PathPlanner::fullResolutionCosts(const StopToken& stop) {
  return followedCostmaps(stop).full_resolution;
}

std::shared_ptr<const CostGrid> PathPlanner::downsampledCosts(const StopToken& stop) {
  return followedCostmaps(stop).downsampled;
}

std::size_t PathPlanner::memoryLimit() const {
  return std::min(memory_limit_, memoryLimitOf(options_.search));
}

// Where planners share the maps, one that plans seldom keeps old ones.
std::size_t PathPlanner::buffers() const {
  return shared_ ? 3 : 2;
}

std::size_t PathPlanner::bytesOfMaps() const {
  return buffers() * map_->values().size();
}

std::size_t PathPlanner::bytesOfCosts() const {
  return CostmapBuilder::bytesFor(map_->geometry(), options_.costmap.kernel, buffers());
}

std::size_t PathPlanner::bytes() const {
  return hasMap() ? bytesOfMaps() + bytesOfCosts() + bytesOfSearches() : 0;
}

std::size_t PathPlanner::bytesOfSearches() const {
  if (!hasMap()) return 0;
  const PreparedPlanners* all = searches_->get();
  return all ? all->current().bytes() + all->bytesOfOthers() : 0;
}

std::size_t PathPlanner::memoryLeft(std::size_t taken) const {
  const GridGeometry& geometry = map_->geometry();
  const std::size_t needed = taken + bytesOfCosts();
  if (needed <= memoryLimit()) return memoryLimit() - needed;
  std::ostringstream text;
  text << "a map of " << geometry.width() << "x" << geometry.height() << " cells takes "
       << needed / 1000000 + 1 << " MB with its costmaps, and memory_limit leaves "
       << memoryLimit() / 1000000 << " MB: raise it or publish a smaller map";
  throw InputError(text.str());
}

CostmapPair PathPlanner::costmaps(const StopToken& stop) {
  assert(hasMap());
  search().limitMemory(memoryLeft(bytesOfMaps()));
  SharedCostmap::Result newest = costmap_->newest(stop, at_least_);
  map_ = std::move(newest.map);
  downsampled_changes_ = newest.costs.downsampled_changes;
  return std::move(newest.costs);
}

void PathPlanner::makeRoom(const CostmapPair& maps) {
  searches_->get()->keepWithin(memoryLeft(bytesOfMaps()),
                               search().bytesFor(maps.downsampled->geometry()));
}

template <class Work>
decltype(auto) PathPlanner::withSearches(Work&& work) {
  return searches_->change([&](PreparedPlanners& all) -> decltype(auto) {
    all.use(options_.planner, options_.search);  // where they were begun anew
    return work();
  });
}

MultiResolutionPlanner& PathPlanner::search() const {
  return searches_->get()->current();
}

CostmapPair PathPlanner::followedCostmaps(const StopToken& stop) {
  return withSearches([&] {
    CostmapPair maps = costmaps(stop);
    search().follow(maps, stop);
    searches_->get()->followOthers(maps, stop);
    return maps;
  });
}

void PathPlanner::prepare(const StopToken& stop) {
  withSearches([&] {
    const CostmapPair maps = costmaps(stop);
    makeRoom(maps);
    search().prepare(maps, stop);
    searches_->get()->followOthers(maps, stop);
  });
}

void PathPlanner::finishPreparation(const StopToken& stop) {
  prepare(stop);
  withSearches([&] { search().finishBackgroundWork(stop); });
}

void PathPlanner::makeReadyForChanges(const StopToken& stop) {
  if (costmap_) costmap_->makeReadyForChanges(stop);
}

std::string PathPlanner::footprintContact(const path::Path& path, std::optional<double> start_yaw,
                                          const StopToken& stop) {
  if (!footprint_ || path.empty()) return "";
  const CostmapPair maps = followedCostmaps(stop);
  FootprintCheck check(*footprint_, *maps.full_resolution, searched_);
  check.allowFor({path.poses.back()});
  const auto contact = check.first(path, start_yaw, path.poses.back().yaw, stop);
  return contact ? check.text(*contact) : "";
}

// On `costs`, which the search is prepared for.
Plan PathPlanner::planFor(const PoseRequest& request, const CostGrid& costs,
                          const StopToken& stop) {
  if (!footprint_) {
    VehicleTerms terms;
    terms.shape = curvesFor(request, searched_, costs, {}, stop);
    return planOnCosts(costs, search(), request, searched_, stop, terms);
  }
  const std::size_t memory = memoryLimit() - std::min(memoryLimit(), bytes());
  const auto inflate = [this](const CostmapOptions& options, const StopToken& until) {
    CostmapBuilder builder(options);
    builder.setMap(map_);
    return builder.fullResolution(until);
  };
  return FittedPlanner(*footprint_, costs, inflate, searched_, memory)
      .plan(search(), request, stop);
}

Plan PathPlanner::plan(const PoseRequest& request, const StopSource& stop) {
  if (!hasMap()) return failedPlan(Status::NO_MAP, "no map has arrived yet");
  return planWithin(options_.timeout, request, stop, [&](const StopToken& token) {
    return withSearches([&] { return planNow(request, token); });
  });
}

Plan PathPlanner::planNow(const PoseRequest& request, const StopToken& token) {
  const auto begin = StopToken::Clock::now();
  const CostmapPair maps = costmaps(token);
  makeRoom(maps);
  if (!threshold_fit_) threshold_fit_ = std::make_unique<grid::ThresholdFit>();
  const std::string& misfit = threshold_fit_->problem(map_, options_.costmap.thresholds, token);
  if (footprint_ && bytes() > memoryLimit() / 2) searches_->get()->releaseOptionalMemory();
  search().prepare(maps, token);
  searches_->get()->followOthers(maps, token);
  const auto prepared = StopToken::Clock::now();
  Plan plan = planFor(request, *maps.full_resolution, token);
  if (plan.found() && plan.sharp_corners > 0 && !options_.keep_sharp_corners) {
    const Plan sharp = std::move(plan);
    plan = failedPlan(Status::UNREACHABLE,
                      "no path that the vehicle can follow was found; that which "
                      "turns on the spot: " +
                          sharp.message);
    plan.answered_by = sharp.answered_by;
    plan.statistics = sharp.statistics;
  }
  addNote(plan.message, misfit);
  plan.preparation_time_s = std::chrono::duration<double>(prepared - begin).count();
  return plan;
}

}  // namespace grid_path_planner::planning
