#include "planners/astar/dijkstra.h"

#include <algorithm>

namespace grid_path_planner::planners {

using base::StopToken;
using grid::Cell, grid::CellRect, grid::GridGeometry;

PlannerTraits Dijkstra::declaredTraits() {
  PlannerTraits traits{"dijkstra"};
  traits.optimal = true;
  traits.several_goals = true;
  traits.repairs = true;
  return traits;
}

Dijkstra::Dijkstra(TieBreak tie_break)
    : Planner(declaredTraits()), strictly_ordered_(tie_break != TieBreak::NONE) {}

std::size_t Dijkstra::bytesFor(const GridGeometry& geometry) const {
  return strictly_ordered_ ? BestFirstSearch::bytesFor(geometry) : BucketSearch::bytesFor(geometry);
}

void Dijkstra::doPrepare(const StopToken& stop) {
  if (strictly_ordered_)
    in_order_.prepare(map(), stop);
  else
    by_buckets_.prepare(map(), stop);
}

void Dijkstra::doUpdate(const std::vector<CellRect>& changed, const StopToken& stop) {
  if (strictly_ordered_)
    in_order_.update(map(), changed, stop);
  else
    by_buckets_.update(map(), changed, stop);
}

SearchResult Dijkstra::doSearch(const SearchRequest& request, const StopToken& stop) {
  std::vector<std::uint32_t> goals;
  for (const Cell goal : request.goals) goals.push_back(map().geometry().index(goal).value());
  std::sort(goals.begin(), goals.end());
  const auto isGoal = [&goals](std::uint32_t index) {
    return std::binary_search(goals.begin(), goals.end(), index);
  };
  if (!strictly_ordered_)
    return by_buckets_.run(map(), request.start, isGoal, noEstimate, request.record_expanded, stop);
  const auto leastCostFirst = [](SearchKey g, Cell) { return BestFirstSearch::Priority{g, 0}; };
  return in_order_.run(map(), request.start, isGoal, leastCostFirst, request.record_expanded, stop);
}

}  // namespace grid_path_planner::planners
