#include "planners/replanning/kept_search_tree.h"

#include <algorithm>
#include <new>

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

// The part of a search's expansions after which an answer is given up, and after which a new tree is
// wanted. An expansion of a repair takes up to twice as long as one of A*.
constexpr std::uint64_t kMostShare = 2;
constexpr std::uint64_t kStaleShare = 16;

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
  stale_ = true;
}

// A search went by without a tree.
void KeptSearchTree::notePayOff(bool same_goal) {
  if (!same_goal || use_ == Use::ANSWERED) {
    in_vain_ = to_wait_ = 0;
  } else if (use_ == Use::MADE) {
    in_vain_ = std::min(in_vain_ + 1, kMostInVain);
    to_wait_ = (1U << in_vain_) - 1;
  } else if (to_wait_ > 0) {
    --to_wait_;
  }
  use_ = Use::NONE;
}

void KeptSearchTree::update(const CostGrid& before, const CostGrid& after,
                            const std::vector<CellRect>& changed, const StopToken& stop) {
  if (!tree_) return;
  if (isLarge(changed, after.geometry())) {
    stale_ = true;
    tree_.reset();
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
  try {
    return tryToSearch(map, request, result, stop);
  } catch (const TooManyCells&) {
    stale_ = true;
  } catch (const TooExpensive&) {
    giveUp();
  } catch (const std::bad_alloc&) {
    giveUp();
  }
  return false;
}

bool KeptSearchTree::tryToSearch(const CostGrid& map, const SearchRequest& request,
                                 SearchResult& result, const StopToken& stop) {
  result.status =
      tree_->plan(map, request.start, request.record_expanded, result, stop, effort_ / kMostShare);
  result.statistics.search_bytes = bytesFor(map.geometry()) + tree_->searchBytes();
  start_ = request.start;
  use_ = Use::ANSWERED;
  stale_ = result.statistics.expanded > effort_ / kStaleShare;
  return true;
}

bool KeptSearchTree::wanted(const CostGrid& map) const {
  return again_ && stale_ && !impossible_ && to_wait_ == 0 && map.passable(start_) &&
         map.passable(goal_);
}

void KeptSearchTree::make(const CostGrid& map, const StopToken& stop) {
  if (use_ == Use::NONE) use_ = Use::MADE;  // stopped, too: there may never be enough idle time
  try {
    if (!tree_) {
      moves_.build(map, stop);
      auto tree = std::make_unique<BackwardSearchTree>();
      tree->prepare(map, moves_);
      tree_ = std::move(tree);
    }
    SearchResult found;
    tree_->build(map, goal_, start_, BackwardSearchTree::kUsualExtra, false, found, stop);
    stale_ = false;
  } catch (const TooExpensive&) {
    giveUp();
  } catch (const std::bad_alloc&) {
    giveUp();
  }
}

}  // namespace grid_path_planner::planners
