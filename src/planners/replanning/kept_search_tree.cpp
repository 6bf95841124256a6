#include "planners/replanning/kept_search_tree.h"

#include <algorithm>
#include <new>

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

// The part of a search's expansions after which an answer is given up, the first time.
constexpr std::uint64_t kMostShare = 2;
// The same that is lost until the tree is repaired.
constexpr std::uint64_t kStaleShare = 16;
// Each time in a row that it was given up halves what the next answer may take, so often at most.
constexpr unsigned kMostGivenUp = 8;

// Rows whose moves are looked up at once.
constexpr int kRows = 16;

// A change of a larger part of the map than this leaves little of a tree, and following it takes long.
constexpr std::size_t kFollowedShare = 64;

// Two to its power is the longest time without a tree, in searches, and one more.
constexpr unsigned kMostInVain = 5;

bool isLarge(const std::vector<CellRect>& changed, const GridGeometry& geometry) {
  std::size_t cells = 0;
  for (const CellRect& rect : changed)
    cells += static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height);
  return cells * kFollowedShare > geometry.size();
}

}  // namespace

void KeptSearchTree::release() {
  *this = KeptSearchTree();
}

// Until release(), so that it is not tried again and again.
void KeptSearchTree::giveUp() {
  release();
  impossible_ = true;
}

// What was lost with a tree does not matter for another one.
void KeptSearchTree::drop() {
  tree_.reset();
  making_ = false;
  given_up_ = 0;
  lost_ = 0;
}

void KeptSearchTree::searched(const CostGrid& map, const SearchRequest& request,
                              std::uint64_t cells) {
  const Cell goal = request.goals.front();
  const bool same = asked_ && goal == goal_;
  notePayOff(same);
  again_ = same && (again_ || map.revision() != revision_);
  asked_ = true;
  goal_ = goal;
  start_ = request.start;
  revision_ = map.revision();
  effort_ = cells;
}

// A search went by without a tree.
void KeptSearchTree::notePayOff(bool same_goal) {
  if (!same_goal || use_ == Use::ANSWERED) {
    in_vain_ = to_wait_ = 0;
  } else if (use_ == Use::MADE && !(tree_ && making_)) {
    in_vain_ = std::min(in_vain_ + 1, kMostInVain);
    to_wait_ = (1U << in_vain_) - 1;
  } else if (to_wait_ > 0) {
    --to_wait_;
  }
  if (!making_) use_ = Use::NONE;
}

void KeptSearchTree::update(const CostGrid& before, const CostGrid& after,
                            const std::vector<CellRect>& changed, const StopToken& stop) {
  if (!tree_) return;
  if (isLarge(changed, after.geometry())) {
    drop();
    return;
  }
  try {
    for (const CellRect& rect : changed) moves_.update(after, rect, stop);
    for (const CellRect& rect : changed) tree_->update(before, after, rect);
  } catch (const std::bad_alloc&) {
    giveUp();
  }
}

bool KeptSearchTree::search(const CostGrid& map, const SearchRequest& request, SearchResult& result,
                            const StopToken& stop) {
  if (!tree_ || !tree_->usableFor(map, request.goals.front())) return false;
  const std::uint64_t most = effort_ / kMostShare >> given_up_;
  try {
    return tryToSearch(map, request, result, stop, most);
  } catch (const TooManyCells&) {
    lost_ += most + effort_;
    given_up_ = std::min(given_up_ + 1, kMostGivenUp);
  } catch (const TooExpensive&) {
    giveUp();
  } catch (const std::bad_alloc&) {
    giveUp();
  }
  return false;
}

bool KeptSearchTree::tryToSearch(const CostGrid& map, const SearchRequest& request,
                                 SearchResult& result, const StopToken& stop, std::uint64_t most) {
  result.status = tree_->plan(map, request.start, request.record_expanded, result, stop, most);
  result.statistics.search_bytes = bytesFor(map.geometry()) + tree_->searchBytes();
  start_ = request.start;
  use_ = Use::ANSWERED;
  given_up_ = 0;
  lost_ += result.statistics.expanded;
  return true;
}

// No tree, or one that searches too much.
bool KeptSearchTree::stale(const CostGrid& map) const {
  return !tree_ || making_ || !tree_->validOn(map, goal_) || lost_ > effort_ / kStaleShare;
}

bool KeptSearchTree::wanted(const CostGrid& map) const {
  return again_ && !impossible_ && to_wait_ == 0 && map.passable(start_) && map.passable(goal_) &&
         stale(map);
}

void KeptSearchTree::make(const CostGrid& map, const StopToken& stop) {
  try {
    goOnMaking(map, stop);
  } catch (const TooExpensive&) {
    giveUp();
  } catch (const std::bad_alloc&) {
    giveUp();
  }
}

void KeptSearchTree::goOnMaking(const CostGrid& map, const StopToken& stop) {
  if (!tree_) prepare(map);
  lookUpMoves(map, stop);
  if (!tree_->growing(map, goal_)) begin(map, stop);
  SearchResult found;
  tree_->grow(map, start_, BackwardSearchTree::kUsualExtra, false, found, stop);
  making_ = false;
  given_up_ = 0;
  lost_ = 0;
  tree_->plan(map, start_, false, found, stop);
}

void KeptSearchTree::begin(const CostGrid& map, const StopToken& stop) {
  if (tree_->usableFor(map, goal_)) {
    tree_->beginRepair(map, start_, stop);
    if (use_ == Use::NONE) use_ = Use::MADE;
  } else {
    tree_->begin(map, goal_, start_);
    use_ = Use::MADE;
  }
  making_ = true;
}

void KeptSearchTree::prepare(const CostGrid& map) {
  moves_.begin(map);
  rows_ = 0;
  auto tree = std::make_unique<BackwardSearchTree>();
  tree->prepare(map, moves_);
  tree_ = std::move(tree);
  making_ = true;
  use_ = Use::MADE;
}

void KeptSearchTree::lookUpMoves(const CostGrid& map, const StopToken& stop) {
  const CellRect all = map.geometry().rect();
  StopPoll poll(stop, 1);
  while (rows_ < all.height) {
    moves_.update(map, CellRect{0, rows_, all.width, kRows}.intersection(all), StopToken());
    rows_ += kRows;
    poll();
  }
}

}  // namespace grid_path_planner::planners
