#include "planning/cost_planner.h"

#include <algorithm>
#include <chrono>
#include <sstream>
#include <utility>

#include "grid/map_differences.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "planning/footprint/fitted_plan.h"
#include "planning/plan_on_costs.h"
#include "vehicle/footprint.h"

namespace grid_path_planner::planning {

using base::checkOptionLimits, base::InputError, base::sameOptions, base::Status, base::StopPoll,
    base::StopSource, base::StopToken;
using costmap::CostGrid, costmap::CostmapBuilder, costmap::CostmapOptions;
using grid::Cell, grid::CellRect, grid::disjointRects, grid::Grid, grid::GridGeometry,
    grid::Occupancy, grid::OccupancyGrid;
using planners::memoryLimitOf, planners::PlannerMaker;
using vehicle::Footprint;

namespace {

// Writes the weights and the classes of the cells of `rect`.
void translate(const Grid<Cost>& costs, const CostWeights& table, const CellRect& rect,
               Grid<CostGrid::Weight>& weights, Grid<Occupancy>& classes, StopPoll& poll) {
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    poll();
    const Cost* from = costs.row(row);
    CostGrid::Weight* weight = weights.row(row);
    Occupancy* occupancy = classes.row(row);
    for (int column = rect.column; column < rect.column + rect.width; ++column) {
      weight[column] = table.weight(from[column]);
      occupancy[column] = CostWeights::classOf(from[column]);
    }
  }
}

void copyRows(const Cost* from, const CellRect& rect, Grid<Cost>& to) {
  const auto width = static_cast<std::size_t>(to.width());
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    std::copy_n(from + static_cast<std::size_t>(row) * width + rect.column, rect.width,
                to.row(row) + rect.column);
}

OccupancyGrid occupancyOf(const Grid<Occupancy>& classes, StopPoll& poll) {
  OccupancyGrid map(classes.geometry());
  const auto valueOf = [](Occupancy occupancy) -> std::int8_t {
    if (occupancy == Occupancy::UNKNOWN) return -1;
    return occupancy == Occupancy::OCCUPIED ? 100 : 0;
  };
  for (int row = 0; row < map.height(); ++row) {
    poll();
    std::transform(classes.row(row), classes.row(row) + map.width(), map.row(row), valueOf);
  }
  return map;
}

// The same weights, blocked also where a disc of the options' radius meets an obstacle.
std::shared_ptr<const CostGrid> inflated(const CostGrid& costs, const CostmapOptions& options,
                                         const StopToken& stop) {
  StopPoll poll(stop, 64);
  CostmapBuilder builder(options);
  builder.setMap(std::make_shared<const OccupancyGrid>(occupancyOf(costs.classes(), poll)));
  const std::shared_ptr<const CostGrid> discs = builder.fullResolution(stop);
  Grid<CostGrid::Weight> weights = costs.weights();
  for (int row = 0; row < weights.height(); ++row) {
    poll();
    for (int column = 0; column < weights.width(); ++column)
      if (!discs->passable({column, row})) weights[Cell{column, row}] = CostGrid::kBlocked;
  }
  auto both = std::make_shared<CostGrid>(std::move(weights), costs.classes(), costs.motion());
  both->setKeptDistances(discs->keptDistances());
  return both;
}

// That inflated() takes beside what the tries of a footprint take.
std::size_t bytesOfInflated(const GridGeometry& geometry) {
  return geometry.size() * (sizeof(std::int8_t) + sizeof(CostGrid::Weight) + sizeof(Occupancy));
}

constexpr std::size_t kBuffers = 2;  // of weights: double_buffered.h

std::size_t bytesFor(const GridGeometry& geometry) {
  return geometry.size() + CostmapBuilder::bytesFor(geometry, 1, kBuffers);
}

}  // namespace

void checkCostPlannerOptions(const CostPlannerOptions& options) {
  checkOptionLimits(options);
  checkCostWeightOptions(options.weights);
  checkPlannerOptions(plannerOptions(options, 0.0));
}

PlannerOptions plannerOptions(const CostPlannerOptions& options, double inscribed_radius) {
  PlannerOptions all;
  all.planner = options.planner;
  all.search = options.search;
  all.costmap.radius = inscribed_radius;
  all.costmap.unknown_is_passable = options.weights.allow_unknown;
  all.costmap.motion = options.motion;
  all.tolerance = options.default_tolerance;
  all.start_escape_radius = options.start_escape_radius;
  all.smooth = options.smooth;
  all.timeout = options.timeout;
  all.heading = options.heading;
  return all;
}

CostPlanner::CostPlanner(const CostPlannerOptions& options, PlannerMaker make_planner)
    : make_planner_(std::move(make_planner)) {
  setOptions(options);
}

void CostPlanner::setOptions(const CostPlannerOptions& options) {
  checkCostPlannerOptions(options);
  const bool new_weights =
      !sameOptions(options.weights, options_.weights) || !(options.motion == options_.motion);
  if (!search_ || new_weights || options.planner != options_.planner ||
      !sameOptions(options.search, options_.search))
    search_ =
        std::make_unique<MultiResolutionPlanner>(options.planner, options.search, make_planner_);
  options_ = options;
  if (new_weights) weights_.reset(nullptr);
}

void CostPlanner::checkMemory(const GridGeometry& geometry) const {
  if (bytesFor(geometry) <= memoryLimitOf(options_.search)) return;
  std::ostringstream text;
  text << "a costmap of " << geometry.width() << "x" << geometry.height() << " cells takes "
       << bytesFor(geometry) / 1000000 + 1 << " MB with its weights, and memory_limit leaves "
       << memoryLimitOf(options_.search) / 1000000 << " MB";
  throw InputError(text.str());
}

void CostPlanner::setCosts(const GridGeometry& geometry, const Cost* costs,
                           double inscribed_radius) {
  if (geometry != costs_.geometry()) {
    checkMemory(geometry);
    Grid<Cost> copy(geometry, std::vector<Cost>(costs, costs + geometry.size()));
    costs_ = std::move(copy);
    weights_.reset(nullptr);
    changed_.clear();
  } else {
    const std::vector<CellRect> changed = grid::differences(costs_, costs);
    addChange(changed, changed_);
    for (const CellRect& rect : changed) copyRows(costs, rect, costs_);
  }
  inscribed_radius_ = inscribed_radius;
}

std::size_t CostPlanner::changedCells() const {
  if (!weights_.current()) return costs_.values().size();
  std::size_t cells = 0;
  for (const CellRect& rect : changed_)
    cells += static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height);
  return cells;
}

CostmapPair CostPlanner::costmaps(const StopToken& stop) {
  const CostWeights table(options_.weights);
  StopPoll poll(stop, 64);
  if (!weights_.current()) {
    Grid<CostGrid::Weight> weights(costs_.geometry());
    Grid<Occupancy> classes(costs_.geometry());
    translate(costs_, table, costs_.geometry().rect(), weights, classes, poll);
    auto first =
        std::make_unique<CostGrid>(std::move(weights), std::move(classes), options_.motion);
    first->setRevision(weights_.nextSeries());
    const std::uint64_t revision = first->revision();
    weights_.reset(std::move(first), revision);
  } else if (!changed_.empty()) {
    weights_.advance({changed_, changed_}, [&](CostGrid& next) {
      next.edit(*weights_.current(), changed_, [&](auto& weights, auto& classes) {
        for (const CellRect& rect : changed_)
          translate(costs_, table, rect, weights, classes, poll);
      });
      next.setRevision(weights_.revision() + 1);
    });
  }
  changed_.clear();
  return {weights_.current(), weights_.current(), weights_.changes(), weights_.changes()};
}

// On `costs`, which the search is prepared for.
Plan CostPlanner::planOn(const CostGrid& costs, const PoseRequest& request,
                         const PlannerOptions& options, const StopToken& stop) {
  if (!options_.use_footprint) return planOnCosts(costs, *search_, request, options, stop);
  const Footprint footprint("the costmap's footprint", footprint_);
  const auto inflate = [&costs](const CostmapOptions& wider, const StopToken& until) {
    return inflated(costs, wider, until);
  };
  const std::size_t taken =
      bytesFor(costs.geometry()) + search_->bytes() + bytesOfInflated(costs.geometry());
  const std::size_t limit = memoryLimitOf(options_.search);
  return FittedPlanner(footprint, costs, inflate, options, limit - std::min(limit, taken))
      .plan(*search_, request, stop);
}

Plan CostPlanner::plan(const PoseRequest& request, double tolerance, const StopSource& stop) {
  if (costs_.values().empty()) return failedPlan(Status::NO_MAP, "no costmap has been given yet");
  PlannerOptions options = plannerOptions(options_, inscribed_radius_);
  options.tolerance = tolerance;
  return planWithin(options.timeout, request, stop, [&](const StopToken& token) {
    const auto begin = StopToken::Clock::now();
    const std::size_t limit = memoryLimitOf(options_.search);
    search_->limitMemory(limit - std::min(limit, bytesFor(costs_.geometry())));
    const CostmapPair maps = costmaps(token);
    search_->prepare(maps, token);
    const auto prepared = StopToken::Clock::now();
    Plan plan = planOn(*maps.full_resolution, request, options, token);
    plan.preparation_time_s = std::chrono::duration<double>(prepared - begin).count();
    return plan;
  });
}

}  // namespace grid_path_planner::planning
