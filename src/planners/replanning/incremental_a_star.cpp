#include "planners/replanning/incremental_a_star.h"

#include <algorithm>
#include <utility>

#include "planners/astar/heuristic.h"
#include "planners/core/bucket_queue.h"
#include "planners/replanning/kept_search_tree.h"

namespace grid_path_planner::planners {

using base::Status, base::Stopped, base::StopToken;
using grid::Cell, grid::CellRect, grid::GridGeometry;

PlannerTraits IncrementalAStar::declaredTraits() {
  PlannerTraits traits{"incremental_a_star"};
  traits.optimal = true;
  traits.repairs = true;
  traits.incremental = true;
  return traits;
}

IncrementalAStar::IncrementalAStar() : Planner(declaredTraits()) {}

std::size_t IncrementalAStar::bytesFor(const GridGeometry& geometry) const {
  return std::max(KeptSearchTree::bytesFor(geometry), BucketSearch::bytesFor(geometry));
}

void IncrementalAStar::doPrepare(const StopToken& stop) {
  a_star_.reset();
  moves_.build(map(), stop);
  if (!tree_) tree_.emplace();
  tree_->prepare(map(), moves_);
}

void IncrementalAStar::doUpdate(const std::vector<CellRect>& changed, const StopToken& stop) {
  if (a_star_) return a_star_->update(sharedMap(), changed, stop);
  for (const CellRect& rect : changed) moves_.update(map(), rect, stop);
  for (const CellRect& rect : changed) tree_->update(previousMap(), map(), rect);
}

SearchResult IncrementalAStar::doSearch(const SearchRequest& request, const StopToken& stop) {
  if (a_star_) return answerOf(*a_star_, request, stop);
  SearchResult result;
  try {
    result.status = planByTree(request, result, stop);
  } catch (const Stopped& stopped) {
    result.status = stopped.status();
  } catch (const TooExpensive&) {
    switchToAStar(stop);
    return answerOf(*a_star_, request, stop);
  }
  result.statistics.search_bytes = KeptSearchTree::bytesFor(map().geometry()) +
                                   tree_->searchBytes() +
                                   result.statistics.peak_open * sizeof(BucketQueue::Index);
  return result;
}

void IncrementalAStar::switchToAStar(const StopToken& stop) {
  AStarOptions options;
  options.heuristic = closedFormFor(map().motion());
  auto a_star = std::make_unique<AStar>(options);
  a_star->prepare(sharedMap(), stop);
  a_star_ = std::move(a_star);
  tree_.reset();
  moves_ = MovePruning();
}

Status IncrementalAStar::planByTree(const SearchRequest& request, SearchResult& result,
                                    const StopToken& stop) {
  const Cell goal = request.goals.front();
  const bool record = request.record_expanded;
  if (tree_->usableFor(map(), goal)) return tree_->plan(map(), request.start, record, result, stop);
  return tree_->build(map(), goal, request.start, BackwardSearchTree::kUsualExtra, record, result,
                      stop);
}

}  // namespace grid_path_planner::planners
