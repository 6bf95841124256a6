#include "planners/jump_point/weighted_jump_point.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "planners/astar/heuristic.h"
#include "planners/core/keys.h"
#include "planners/tables/precomputed_heuristic.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::Connectivity, costmap::CostGrid, costmap::DiagonalCost, costmap::MotionModel;
using grid::CellRect, grid::GridGeometry;

namespace {

bool jumpsSupport(const MotionModel& motion) {
  return motion == MotionModel();
}

// Whether a search option is not the default.
bool asksForAStar(const AStarOptions& options) {
  const AStarOptions defaults;
  return options.heuristic != defaults.heuristic || options.epsilon != defaults.epsilon ||
         options.heuristic_scale != defaults.heuristic_scale ||
         options.tie_break != defaults.tie_break;
}

}  // namespace

PlannerTraits WeightedJumpPoint::declaredTraits() {
  PlannerTraits traits{"weighted_jump_point"};
  traits.optimal = true;
  traits.repairs = true;
  return traits;
}

WeightedJumpPoint::WeightedJumpPoint(const AStarOptions& options)
    : Planner(declaredTraits()), options_(options), a_star_asked_for_(asksForAStar(options)) {
  checkAStarOptions(options);
}

// The given options, or the defaults with the best heuristic of the motion model.
AStarOptions WeightedJumpPoint::optionsOfAStar(const MotionModel& motion) const {
  AStarOptions options = options_;
  if (a_star_asked_for_) return options;
  if (motion.connectivity == Connectivity::FOUR)
    options.heuristic = Heuristic::MANHATTAN;
  else if (motion.diagonal_cost == DiagonalCost::UNIT)
    options.heuristic = Heuristic::CHEBYSHEV;
  return options;
}

bool WeightedJumpPoint::optimalFor(const CostGrid& map) const {
  return optimalWith(optionsOfAStar(map.motion()), map);
}

// Both where A* answers searches until the jumps are prepared.
std::size_t WeightedJumpPoint::bytesFor(const GridGeometry& geometry) const {
  if (jumps_ready_ && a_star_)
    return WeightedJumpSearch::bytesFor(geometry) + AStar(options_).bytesFor(geometry);
  return std::max(WeightedJumpSearch::bytesFor(geometry), AStar(options_).bytesFor(geometry));
}

std::string WeightedJumpPoint::lessMemoryAdvice() const {
  const std::string advice = PrecomputedHeuristic::lessMemoryAdvice(options_);
  return advice.empty() ? Planner::lessMemoryAdvice() : advice;
}

BackgroundWork WeightedJumpPoint::backgroundWork() {
  BackgroundWork work = a_star_ ? a_star_->backgroundWork() : BackgroundWork();
  work.pending = work.pending || (jumps_ready_ && !jumps_.finished());
  return work;
}

void WeightedJumpPoint::finishBackgroundWork(const StopToken& stop) {
  if (jumps_ready_) {
    jumps_.finish(map(), stop);
    a_star_.reset();
  }
  if (a_star_) a_star_->finishBackgroundWork(stop);
}

bool WeightedJumpPoint::shouldJump() const {
  return !a_star_asked_for_ && jumpsSupport(map().motion()) && pruning_.jumpingPays();
}

void WeightedJumpPoint::doPrepare(const StopToken& stop) {
  a_star_.reset();
  jumps_ready_ = false;
  if (jumpsSupport(map().motion())) pruning_.sample(map(), stop);
  if (!shouldJump()) {
    jumps_.release();
    prepareAStar(stop);
    return;
  }
  jumps_.prepare(map());
  jumps_ready_ = true;
  too_many_tiles_ = 0;
}

void WeightedJumpPoint::doUpdate(const std::vector<CellRect>& changed, const StopToken& stop) {
  if (jumpsSupport(map().motion()))
    for (const CellRect& rect : changed) pruning_.update(map(), rect);
  if (shouldJump() != jumps_ready_) return doPrepare(stop);
  if (jumps_ready_) jumps_.update(map(), changed, stop);
  if (a_star_) a_star_->update(sharedMap(), changed, stop);
}

void WeightedJumpPoint::prepareAStar(const StopToken& stop) {
  auto a_star = std::make_unique<AStar>(optionsOfAStar(map().motion()));
  a_star->prepare(sharedMap(), stop);
  a_star_ = std::move(a_star);
}

// That a search may make: all of them where memory for A* is not left.
std::uint64_t WeightedJumpPoint::mostTiles() const {
  constexpr std::uint64_t kFewest = 8;
  constexpr auto kAll = std::numeric_limits<std::uint64_t>::max();
  if (jumps_.finished()) return kAll;
  const GridGeometry& geometry = map().geometry();
  const std::size_t both =
      WeightedJumpSearch::bytesFor(geometry) + AStar(options_).bytesFor(geometry);
  if (both > memoryLimit()) return kAll;
  // Tiles far from each other touch so many new pages of memory that they cost more than A*.
  constexpr std::size_t kMostCells = std::size_t{1} << 26;
  if (geometry.size() > kMostCells) return 0;
  if (too_many_tiles_ >= 5) return kAll;
  constexpr std::size_t kTileCells = WeightedJumpMap::kTile * WeightedJumpMap::kTile;
  return std::max<std::uint64_t>(kFewest, geometry.size() / kTileCells / 32 << too_many_tiles_);
}

SearchResult WeightedJumpPoint::doSearch(const SearchRequest& request, const StopToken& stop) {
  if (jumps_ready_) {
    try {
      return jumps_.run(map(), request, stop, mostTiles());
    } catch (const TooManyTiles&) {
      ++too_many_tiles_;
      if (!a_star_) prepareAStar(stop);
    } catch (const TooExpensive&) {
      if (!a_star_) prepareAStar(stop);
    }
  }
  return a_star_->search(request, stop);
}

}  // namespace grid_path_planner::planners
