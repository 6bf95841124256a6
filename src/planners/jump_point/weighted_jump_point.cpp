#include "planners/jump_point/weighted_jump_point.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "planners/astar/heuristic.h"
#include "planners/core/keys.h"
#include "planners/jump_point/jump_point.h"
#include "planners/replanning/incremental_a_star.h"

namespace grid_path_planner::planners {

using base::Status, base::Stopped, base::StopToken;
using costmap::CostGrid, costmap::MotionModel;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

// After how many expansions the bound of the blocks is made: it takes about as long as several
// thousand of them.
constexpr std::size_t kEarly = 64;
constexpr std::size_t kLate = 65536;

// Tiles of a map of which all may be made at once.
constexpr std::size_t kSmallMap = 8;
// On maps of more, tiles far from each other touch so many new pages of memory that they cost more than
// A*.
constexpr std::size_t kMostCells = std::size_t{1} << 26;
// Changes that the jumps have not followed yet: in the time of 1 to 5 ms.
constexpr std::size_t kMostBehind = 16;
// A search comes to more tiles than lie on the straight line to its goal, seldom to fewer than this
// many times as many.
constexpr int kTilesBesideLine = 2;

std::uint64_t tilesExpected(const SearchRequest& request) {
  const Cell goal = request.goals.front();
  const int straight = std::max(std::abs(goal.column - request.start.column),
                                std::abs(goal.row - request.start.row));
  return std::uint64_t(straight / WeightedJumpMap::kTile) * kTilesBesideLine;
}

// Expansions of A* in whose time jumps expand one cell, on inflated maps.
constexpr std::uint64_t kCellsOfAJump = 8;
// Searches of fewer expansions are nearly as fast as a tree.
constexpr std::uint64_t kLeastForTree = 4096;

bool jumpsSupport(const MotionModel& motion) {
  return motion == MotionModel();
}

// Whether a search option is not the default, but for landmarks.
bool asksForAStar(const AStarOptions& options) {
  const AStarOptions defaults;
  const bool other_heuristic =
      options.heuristic != defaults.heuristic && options.heuristic != Heuristic::LANDMARK;
  return other_heuristic || options.epsilon != defaults.epsilon ||
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
    : Planner(declaredTraits()),
      options_(options),
      a_star_asked_for_(asksForAStar(options)),
      landmarks_asked_for_(!a_star_asked_for_ && options.heuristic == Heuristic::LANDMARK),
      landmarks_(a_star_asked_for_ || landmarks_asked_for_ ? 0 : options.landmarks) {
  checkAStarOptions(options);
}

// The given options, or the defaults with the best heuristic of the motion model.
AStarOptions WeightedJumpPoint::optionsOfAStar(const CostGrid& map) const {
  AStarOptions options = options_;
  if (a_star_asked_for_ || landmarks_asked_for_) return options;
  options.heuristic = map.uniform() ? closedFormFor(map.motion()) : Heuristic::BLOCKS;
  return options;
}

bool WeightedJumpPoint::optimalFor(const CostGrid& map) const {
  return optimalWith(optionsOfAStar(map), map);
}

BackgroundWork WeightedJumpPoint::doBackgroundWork() {
  BackgroundWork work = substitute_ ? substitute_->backgroundWork() : BackgroundWork();
  work.pending = work.pending || estimatesLater() || !behind_.empty() ||
                 (shouldJump() && !(jumps_ready_ && jumps_.finished())) || treeWanted() ||
                 (jumps_ready_ && landmarks_.wanted(map(), roomForLandmarks()));
  return work;
}

void WeightedJumpPoint::doFinishBackgroundWork(const StopToken& stop) {
  sampleLate(stop);
  if (shouldJump()) {
    if (!jumps_ready_) prepareJumps(stop);
    catchUp(stop);
    jumps_.finish(map(), stop);
    if (!landmarks_asked_for_) substitute_.reset();
  }
  if (substitute_) substitute_->finishBackgroundWork(stop);
  if (treeWanted()) tree_.make(map(), stop);
  if (jumps_ready_ && jumps_.finished()) landmarks_.make(sharedMap(), roomForLandmarks(), stop);
}

bool WeightedJumpPoint::treeWanted() const {
  return !a_star_asked_for_ && !map().uniform() && tree_.wanted(map()) && treeFits();
}

// Whether the options and the map allow it.
bool WeightedJumpPoint::mayJump() const {
  if (a_star_asked_for_ || !jumpsSupport(map().motion())) return false;
  return !landmarks_asked_for_ || (!map().uniform() && bytesOfBoth() <= memoryLimit());
}

bool WeightedJumpPoint::shouldJump() const {
  if (!mayJump()) return false;
  return map().uniform() ? density_.jumpsPay() : sampled_ && pruning_.jumpingPays();
}

// Whether jumps may pay, and nobody has looked yet.
bool WeightedJumpPoint::estimatesLater() const {
  return mayJump() && !map().uniform() && !sampled_;
}

void WeightedJumpPoint::sampleLate(const StopToken& stop) {
  if (!estimatesLater()) return;
  pruning_.sample(map(), stop);
  sampled_ = true;
}

int WeightedJumpPoint::blockOfBound() const {
  const bool small = pruning_.octileSaysNothing(map().minWeight());
  return small ? WeightedJumpSearch::kSmallBlock : WeightedJumpSearch::kBlock;
}

void WeightedJumpPoint::doPrepare(const StopToken& stop) {
  substitute_.reset();
  tree_.release();
  jumps_ready_ = sampled_ = counted_ = false;
  tiles_.reset();
  landmarks_.release();
  jumps_.release();
  behind_.clear();
  bound_of_a_star_.prepare(map());
  estimate({}, stop);
  const bool jumps = shouldJump() && !map().uniform();
  if (jumps) prepareJumps(stop);
  if (!jumps || landmarks_asked_for_) prepareSubstitute(stop);
}

// Of the kind that the map is of.
void WeightedJumpPoint::estimate(const std::vector<CellRect>& changed, const StopToken& stop) {
  const bool jumps = mayJump();
  const bool one_weight = jumps && map().uniform();
  if (!one_weight) {
    counted_ = false;
  } else if (counted_) {
    for (const CellRect& rect : changed) density_.update(map().bitMaps(stop), rect);
  } else {
    density_.sample(map().bitMaps(stop), stop);
    counted_ = true;
  }
  if (!jumps || one_weight) {
    pruning_ = PruningEstimate();
    sampled_ = false;
  } else if (sampled_) {
    for (const CellRect& rect : changed) pruning_.update(map(), rect);
  } else if (jumps_ready_ || isSmall()) {  // ready: those of one weight, until now
    pruning_.sample(map(), stop);
    sampled_ = true;
  }
}

// The substitute goes where memory does not hold both.
void WeightedJumpPoint::prepareJumps(const StopToken& stop) {
  if (bytesOfBoth() > memoryLimit()) substitute_.reset();
  jumps_.prepare(map(), stop, blockOfBound());
  bound_of_jumps_.prepare(map());
  jumps_ready_ = true;
  if (isSmall()) tiles_.add(2 * kSmallMap);
}

void WeightedJumpPoint::doUpdate(const std::vector<CellRect>& changed, const StopToken& stop) {
  bound_of_a_star_.update(map(), changed);
  if (jumps_ready_) bound_of_jumps_.update(map(), changed);
  estimate(changed, stop);
  const bool jumps = shouldJump();
  if (jumps_ready_ && !jumps) return doPrepare(stop);
  if (jumps_ready_) updateJumps(changed, stop);
  if (substitute_) updateSubstitute(changed, stop);
  if (!jumps_ready_ && jumps && !map().uniform()) prepareJumps(stop);
  if (map().uniform()) {
    tree_.release();
    landmarks_.release();
  }
  tree_.update(previousMap(), map(), changed, stop);
  landmarks_.update(previousMap(), sharedMap(), changed);
}

// Another one where the map has become one for the other kind.
void WeightedJumpPoint::updateSubstitute(const std::vector<CellRect>& changed,
                                         const StopToken& stop) {
  if (substitute_jumps_ == jumpPointSubstitutes())
    return substitute_->update(sharedMap(), changed, stop);
  substitute_.reset();
  if (!jumps_ready_) prepareSubstitute(stop);
}

// Beside a tree that may answer they wait for idle time, or for the next search that asks for jumps:
// repairing their tiles takes longer than the tree's answer.
void WeightedJumpPoint::updateJumps(const std::vector<CellRect>& changed, const StopToken& stop) {
  grid::addChange(changed, behind_);
  if (!tree_.held() || behind_.size() > kMostBehind) catchUp(stop);
}

// Where it is stopped the next one does it again.
void WeightedJumpPoint::catchUp(const StopToken& stop) {
  if (behind_.empty()) return;
  const std::size_t ready = jumps_.tilesReady();
  try {
    jumps_.update(map(), behind_, stop, blockOfBound());
  } catch (const Stopped&) {
    tiles_.addUndone(ready - jumps_.tilesReady());
    throw;
  }
  behind_.clear();
  tiles_.addUndone(ready - jumps_.tilesReady());
}

bool WeightedJumpPoint::isSmall() const {
  constexpr std::size_t kTileCells = WeightedJumpMap::kTile * WeightedJumpMap::kTile;
  return map().geometry().size() / kTileCells <= kSmallMap;
}

// Whether JumpPoint is the one that answers where the jumps do not.
bool WeightedJumpPoint::jumpPointSubstitutes() const {
  return !a_star_asked_for_ && !landmarks_asked_for_ && jumpsSupport(map().motion()) &&
         map().uniform() && !density_.aStarPays();
}

void WeightedJumpPoint::prepareSubstitute(const StopToken& stop) {
  const bool jumps = jumpPointSubstitutes();
  std::unique_ptr<Planner> substitute;
  if (jumps)
    substitute = std::make_unique<JumpPoint>();
  else if (a_star_asked_for_ || landmarks_asked_for_)
    substitute = std::make_unique<AStar>(options_);
  else
    substitute = std::make_unique<AStar>(optionsOfAStar(map()), bound_of_a_star_);
  substitute->prepare(sharedMap(), stop);
  substitute_ = std::move(substitute);
  substitute_jumps_ = jumps;
}

// That a search may make: all of them where memory for the substitute is not left.
std::uint64_t WeightedJumpPoint::mostTiles() const {
  constexpr auto kAll = std::numeric_limits<std::uint64_t>::max();
  if (jumps_.finished()) return kAll;
  if (bytesOfBoth() > memoryLimit()) return kAll;
  return map().geometry().size() > kMostCells ? 0 : tiles_.left();
}

// From the last search, which did not wait for it.
void WeightedJumpPoint::learnFromJumps(const StopToken& stop) {
  if (!bound_of_jumps_.undecided() || map().uniform()) return;
  if (const auto evidence = jumps_.evidence(stop)) bound_of_jumps_.learn(*evidence);
}

// Once the substitute, which is A* then, has those that are asked for, or others are paid for.
std::optional<LandmarkBound> WeightedJumpPoint::landmarksTo(Cell goal) {
  if (!landmarks_asked_for_)
    return landmarks_.boundTo(map().geometry().index(goal).value(), kMediumScale);
  if (!substitute_) return std::nullopt;
  return static_cast<AStar&>(*substitute_).landmarkBound(goal, kMediumScale);
}

// Nothing where it would have to make more tiles than it may, or its keys do not hold the cost.
std::optional<SearchResult> WeightedJumpPoint::searchWithJumps(const SearchRequest& request,
                                                               const StopToken& stop) {
  catchUp(stop);
  const std::uint64_t most = mostTiles();
  const std::size_t ready = jumps_.tilesReady();
  if (most < tilesExpected(request) && ready < tilesExpected(request)) return std::nullopt;
  learnFromJumps(stop);
  jumps_.makeBoundAfter(bound_of_jumps_.blocks() ? kEarly : kLate);
  const auto spend = [&] { tiles_.spend(jumps_.tilesReady() - ready); };
  try {
    SearchResult result =
        jumps_.run(map(), request, stop, most, landmarksTo(request.goals.front()));
    spend();
    result.statistics.search_bytes += bytesOfTables();
    return result;
  } catch (const TooManyTiles&) {
    spend();
  } catch (const TooExpensive&) {
  }
  return std::nullopt;
}

SearchResult WeightedJumpPoint::doSearch(const SearchRequest& request, const StopToken& stop) {
  if (a_star_asked_for_ || map().uniform()) return searchAnew(request, stop);
  const grid::GridGeometry& geometry = map().geometry();
  if (bytesOfSearches(geometry) + bytesBesideSearches(geometry) > memoryLimit())
    releaseOptionalMemory();
  SearchResult by_tree;
  if (tree_.search(map(), request, by_tree, stop)) {
    by_tree.answered_by = IncrementalAStar::declaredTraits().name;
    return by_tree;
  }
  SearchResult result = searchAnew(request, stop);
  const bool by_jumps = result.answered_by.empty();
  const std::uint64_t cells = result.statistics.expanded * (by_jumps ? kCellsOfAJump : 1);
  landmarks_.pay(cells);
  if (result.status == Status::FOUND && cells >= kLeastForTree)
    tree_.searched(map(), request, cells);
  result.statistics += by_tree.statistics;
  result.expanded.insert(result.expanded.begin(), by_tree.expanded.begin(), by_tree.expanded.end());
  return result;
}

SearchResult WeightedJumpPoint::searchAnew(const SearchRequest& request, const StopToken& stop) {
  if (tiles_.left() > 0 && !jumps_ready_ && !map().uniform()) {
    sampleLate(stop);
    if (shouldJump()) prepareJumps(stop);
  }
  if (jumps_ready_) {
    if (std::optional<SearchResult> result = searchWithJumps(request, stop))
      return *std::move(result);
  }
  if (!substitute_) prepareSubstitute(stop);
  SearchResult result = answerOf(*substitute_, request, stop);
  // JumpPoint's pay for none: where it answers, tiles are made in idle time.
  const std::size_t cells = map().geometry().size();
  if (!substitute_jumps_ && cells <= kMostCells) tiles_.pay(result.statistics.expanded, cells);
  return result;
}

}  // namespace grid_path_planner::planners
