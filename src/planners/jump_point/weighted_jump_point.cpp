#include "planners/jump_point/weighted_jump_point.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "planners/astar/heuristic.h"
#include "planners/core/keys.h"
#include "planners/tables/precomputed_heuristic.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::Connectivity, costmap::CostGrid, costmap::DiagonalCost, costmap::MotionModel;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

// After how many expansions the bound of the blocks is made: it takes about as long as several
// thousand of them.
constexpr std::size_t kEarly = 64;
constexpr std::size_t kLate = 65536;

// Expansions of A* for which a search may make one more tile of the jumps.
constexpr std::size_t kTilePrice = 65536;
constexpr std::size_t kPlainTilePrice = 4096;
// Tiles that may be made before: all of small maps, and of maps of one weight a part.
constexpr std::size_t kSmallMap = 8;
constexpr std::size_t kFirstPart = 32;
// Tiles that an update undid and that may be made again at once: in the time of 1 to 5 ms.
constexpr std::uint64_t kMostRemade = 32;
// A search comes to more tiles than lie on the straight line to its goal, seldom to fewer than this
// many times as many.
constexpr int kTilesBesideLine = 2;

std::uint64_t tilesExpected(const SearchRequest& request) {
  const Cell goal = request.goals.front();
  const int straight = std::max(std::abs(goal.column - request.start.column),
                                std::abs(goal.row - request.start.row));
  return std::uint64_t(straight / WeightedJumpMap::kTile) * kTilesBesideLine;
}

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
AStarOptions WeightedJumpPoint::optionsOfAStar(const CostGrid& map) const {
  const MotionModel& motion = map.motion();
  AStarOptions options = options_;
  if (a_star_asked_for_) return options;
  if (motion.connectivity == Connectivity::FOUR)
    options.heuristic = Heuristic::MANHATTAN;
  else if (motion.diagonal_cost == DiagonalCost::UNIT)
    options.heuristic = Heuristic::CHEBYSHEV;
  if (!map.uniform()) options.heuristic = Heuristic::BLOCKS;
  return options;
}

bool WeightedJumpPoint::optimalFor(const CostGrid& map) const {
  return optimalWith(optionsOfAStar(map), map);
}

// Both where A* answers searches until the jumps are prepared.
std::size_t WeightedJumpPoint::bytesFor(const GridGeometry& geometry) const {
  if (jumps_ready_ && a_star_)
    return WeightedJumpSearch::bytesFor(geometry) + bytesOfAStar(geometry);
  return std::max(WeightedJumpSearch::bytesFor(geometry), bytesOfAStar(geometry));
}

std::size_t WeightedJumpPoint::bytesOfAStar(const GridGeometry& geometry) const {
  AStarOptions options = options_;
  if (!a_star_asked_for_) options.heuristic = Heuristic::BLOCKS;
  return AStar(options).bytesFor(geometry);
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

int WeightedJumpPoint::blockOfBound() const {
  const bool small = pruning_.octileSaysNothing(map().minWeight());
  return small ? WeightedJumpSearch::kSmallBlock : WeightedJumpSearch::kBlock;
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
  jumps_.prepare(map(), stop, blockOfBound());
  jumps_ready_ = true;
  tiles_left_ = firstTiles();
  paid_ = 0;
}

void WeightedJumpPoint::doUpdate(const std::vector<CellRect>& changed, const StopToken& stop) {
  if (jumpsSupport(map().motion()))
    for (const CellRect& rect : changed) pruning_.update(map(), rect);
  if (shouldJump() != jumps_ready_) return doPrepare(stop);
  if (jumps_ready_) updateJumps(changed, stop);
  if (a_star_) a_star_->update(sharedMap(), changed, stop);
}

// Few tiles that the change undid are made anew by the searches that come to them: A* in their place
// would take longer.
void WeightedJumpPoint::updateJumps(const std::vector<CellRect>& changed, const StopToken& stop) {
  const std::size_t ready = jumps_.tilesReady();
  jumps_.update(map(), changed, stop, blockOfBound());
  const std::uint64_t undone = ready - jumps_.tilesReady();
  if (undone <= kMostRemade) tiles_left_ += undone;
}

std::uint64_t WeightedJumpPoint::firstTiles() const {
  constexpr std::size_t kTileCells = WeightedJumpMap::kTile * WeightedJumpMap::kTile;
  const std::size_t tiles = map().geometry().size() / kTileCells;
  if (map().uniform()) return std::max(kSmallMap, tiles / kFirstPart);
  return tiles <= kSmallMap ? 2 * kSmallMap : 0;
}

void WeightedJumpPoint::prepareAStar(const StopToken& stop) {
  auto a_star = std::make_unique<AStar>(optionsOfAStar(map()));
  a_star->prepare(sharedMap(), stop);
  a_star_ = std::move(a_star);
}

// That a search may make: all of them where memory for A* is not left.
std::uint64_t WeightedJumpPoint::mostTiles() const {
  constexpr auto kAll = std::numeric_limits<std::uint64_t>::max();
  if (jumps_.finished()) return kAll;
  const GridGeometry& geometry = map().geometry();
  const std::size_t both = WeightedJumpSearch::bytesFor(geometry) + bytesOfAStar(geometry);
  if (both > memoryLimit()) return kAll;
  // Tiles far from each other touch so many new pages of memory that they cost more than A*.
  constexpr std::size_t kMostCells = std::size_t{1} << 26;
  return geometry.size() > kMostCells ? 0 : tiles_left_;
}

// What A* expanded pays for tiles: of one weight they are made in the time of some thousand
// expansions, of several in that of ten thousand, and little is lost if they are never used.
void WeightedJumpPoint::payForTiles(std::size_t expanded) {
  paid_ += expanded;
  const std::size_t price = map().uniform() ? kPlainTilePrice : kTilePrice;
  tiles_left_ += paid_ / price;
  paid_ %= price;
}

// Nothing where it would have to make more tiles than it may, or its keys do not hold the cost.
std::optional<SearchResult> WeightedJumpPoint::searchWithJumps(const SearchRequest& request,
                                                               const StopToken& stop) {
  const std::uint64_t most = mostTiles();
  const std::size_t ready = jumps_.tilesReady();
  if (most < tilesExpected(request) && ready < tilesExpected(request)) return std::nullopt;
  const bool early = pruning_.octileSaysLittle(map().minWeight());
  jumps_.makeBoundAfter(early ? kEarly : kLate);
  const auto spend = [&] { tiles_left_ -= std::min(tiles_left_, jumps_.tilesReady() - ready); };
  try {
    SearchResult result = jumps_.run(map(), request, stop, most);
    spend();
    return result;
  } catch (const TooManyTiles&) {
    spend();
  } catch (const TooExpensive&) {
  }
  return std::nullopt;
}

SearchResult WeightedJumpPoint::doSearch(const SearchRequest& request, const StopToken& stop) {
  if (jumps_ready_) {
    if (std::optional<SearchResult> result = searchWithJumps(request, stop))
      return *std::move(result);
    if (!a_star_) prepareAStar(stop);
  }
  SearchResult result = a_star_->search(request, stop);
  payForTiles(result.statistics.expanded);
  return result;
}

}  // namespace grid_path_planner::planners
