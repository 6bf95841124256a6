#include "grid_path_planner/planning/path_planner.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <sstream>
#include <utility>

#include "grid/foreign_values.h"
#include "grid_path_planner/base/options.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "path/footprint/footprint.h"
#include "planning/footprint/fitted_plan.h"
#include "planning/map_store.h"
#include "planning/message_text.h"
#include "planning/multi_resolution_planner.h"
#include "planning/plan_on_costs.h"
#include "planning/prepared_planners.h"
#include "planning/turning/curves.h"

namespace grid_path_planner::planning {

using base::checkOptionLimits, base::choiceName, base::InputError, base::sameOptions, base::Status,
    base::StopSource, base::StopToken;
using costmap::checkCostmapOptions, costmap::CostGrid, costmap::CostmapBuilder,
    costmap::CostmapOptions, costmap::keptDistances, costmap::KeptDistances;
using grid::CellRect, grid::checkOccupancyValues, grid::GridGeometry, grid::OccupancyGrid;
using path::Footprint, path::HeadingMode;
using planners::checkSearchOptions, planners::memoryLimitOf, planners::PlannerMaker,
    planners::traitsOf;

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

// A costmap that keeps less from unknown cells and from the border, and its search.
struct PathPlanner::Lowered {
  Lowered(std::shared_ptr<SharedCostmap> costs, const PlannerOptions& options,
          PlannerMaker make_planner)
      : costmap(std::move(costs)),
        search(options.planner, options.search, std::move(make_planner)) {}

  std::shared_ptr<SharedCostmap> costmap;
  MultiResolutionPlanner search;
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

void PathPlanner::setOptions(const PlannerOptions& options) {
  Footprint footprint = checkOtherOptions(options);
  PlannerOptions searched = options;
  searched.costmap.radius = std::max(options.costmap.radius, footprint.inscribedRadius());
  const bool new_costmap = !searches_ || !sameOptions(searched.costmap, searched_.costmap);
  const bool new_search = new_costmap || options.planner != options_.planner ||
                          !sameOptions(options.search, options_.search);
  if (new_search) {
    if (!searches_) searches_ = std::make_unique<PreparedPlanners>(make_planner_);
    searches_->use(options.planner, options.search);
    lowered_.reset();
  }
  costmap_is_old_ = costmap_is_old_ || new_costmap;
  options_ = options;
  searched_ = std::move(searched);
  footprint_.reset(footprint.empty() ? nullptr : new Footprint(std::move(footprint)));
  if (costmap_is_old_) useCostmap();
}

// The searches are of other costs. Where memory fails meanwhile, it is begun again with the next map or options.
void PathPlanner::useCostmap() {
  costmap_is_old_ = true;
  searches_->giveUpOthers();
  searches_->current() = {options_.planner, options_.search, make_planner_};
  lowered_.reset();
  costmap_ =
      series_ ? series_->costmap(searched_.costmap, keptDistances(searched_.costmap)) : nullptr;
  costmap_is_old_ = false;
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
  at_least_ = at_least;
  std::shared_ptr<MapSeries> series = store_->series();
  if (!series) return;
  if (series->geometry().size() == 0) throw InputError(kNoCells);
  map_ = series->newest().map;
  if (series == series_ && !costmap_is_old_) return;
  series_ = std::move(series);
  useCostmap();
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
  return search().bytes() + searches_->bytesOfOthers() +
         (lowered_ ? bytesOfCosts() + lowered_->search.bytes() : 0);
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
  // It is kept for the next plan from there, but not where others may want its memory.
  if (lowered_ && bytes() > memoryLimit() / 2) lowered_.reset();
  search().limitMemory(memoryLeft(bytesOfMaps()));
  SharedCostmap::Result newest = costmap_->newest(stop, at_least_);
  map_ = std::move(newest.map);
  downsampled_changes_ = newest.costs.downsampled_changes;
  return std::move(newest.costs);
}

void PathPlanner::makeRoom(const CostmapPair& maps) {
  searches_->keepWithin(memoryLeft(bytesOfMaps()), search().bytesFor(maps.downsampled->geometry()));
}

MultiResolutionPlanner& PathPlanner::search() const {
  return searches_->current();
}

// Where an end of the request is nearer to unknown cells or to the border than what is kept, what is
// searched keeps no more than the end has; else null.
PathPlanner::Lowered* PathPlanner::loweredFor(const CostGrid& costs, const PoseRequest& request) {
  const KeptDistances kept = EndSegments(costs).loweredTo(request.start.position.head<2>(),
                                                          request.goal.position.head<2>());
  if (kept == costs.keptDistances()) {
    lowered_.reset();
  } else if (!lowered_ || lowered_->costmap->keptDistances() != kept) {
    lowered_ = std::make_unique<Lowered>(series_->costmap(searched_.costmap, kept), options_,
                                         make_planner_);
  }
  return lowered_.get();
}

CostmapPair PathPlanner::loweredCosts(Lowered& lowered, const StopToken& stop) {
  lowered.search.limitMemory(
      memoryLeft(bytesOfMaps() + bytesOfSearches() - lowered.search.bytes()));
  SharedCostmap::Result newest = lowered.costmap->newest(stop);
  map_ = std::move(newest.map);
  return std::move(newest.costs);
}

CostmapPair PathPlanner::followedCostmaps(const StopToken& stop) {
  CostmapPair maps = costmaps(stop);
  search().follow(maps, stop);
  searches_->followOthers(maps, stop);
  return maps;
}

void PathPlanner::prepare(const StopToken& stop) {
  const CostmapPair maps = costmaps(stop);
  makeRoom(maps);
  search().prepare(maps, stop);
  searches_->followOthers(maps, stop);
}

void PathPlanner::finishPreparation(const StopToken& stop) {
  prepare(stop);
  search().finishBackgroundWork(stop);
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

// On `costs`, which `search` is prepared for.
Plan PathPlanner::planFor(const PoseRequest& request, const CostGrid& costs,
                          MultiResolutionPlanner& search, const StopToken& stop) {
  if (!footprint_) {
    VehicleTerms terms;
    terms.shape = curvesFor(request, searched_, costs, {}, stop);
    return planOnCosts(costs, search, request, searched_, stop, terms);
  }
  const std::size_t memory = memoryLimit() - std::min(memoryLimit(), bytes());
  const auto inflate = [this](const CostmapOptions& options, const KeptDistances& kept,
                              const StopToken& until) {
    CostmapBuilder builder(options, kept);
    builder.setMap(map_);
    return builder.fullResolution(until);
  };
  return FittedPlanner(*footprint_, costs, inflate, searched_, memory).plan(search, request, stop);
}

Plan PathPlanner::plan(const PoseRequest& request, const StopSource& stop) {
  if (!hasMap()) return failedPlan(Status::NO_MAP, "no map has arrived yet");
  return planWithin(options_.timeout, request, stop, [&](const StopToken& token) {
    const auto begin = StopToken::Clock::now();
    const CostmapPair asked_for = costmaps(token);
    CostmapPair maps = asked_for;
    makeRoom(maps);
    if (!threshold_fit_) threshold_fit_ = std::make_unique<grid::ThresholdFit>();
    const std::string& misfit = threshold_fit_->problem(map_, options_.costmap.thresholds, token);
    Lowered* lowered = loweredFor(*maps.full_resolution, request);
    if ((lowered || footprint_) && bytes() > memoryLimit() / 2) searches_->releaseOptionalMemory();
    if (lowered) maps = loweredCosts(*lowered, token);
    MultiResolutionPlanner& search = lowered ? lowered->search : this->search();
    search.prepare(maps, token);
    searches_->followOthers(asked_for, token);
    const auto prepared = StopToken::Clock::now();
    Plan plan = planFor(request, *maps.full_resolution, search, token);
    if (plan.found() && plan.sharp_corners > 0 && !options_.keep_sharp_corners) {
      const Plan sharp = std::move(plan);
      plan = failedPlan(Status::UNREACHABLE,
                        "no path that the vehicle can follow was found; that which "
                        "turns on the spot: " +
                            sharp.message);
      plan.answered_by = sharp.answered_by;
      plan.statistics = sharp.statistics;
    }
    if (lowered && plan.found())
      addNote(plan.message,
              loweredNote(costmap_->keptDistances(), lowered->costmap->keptDistances()));
    addNote(plan.message, misfit);
    plan.preparation_time_s = std::chrono::duration<double>(prepared - begin).count();
    return plan;
  });
}

}  // namespace grid_path_planner::planning
