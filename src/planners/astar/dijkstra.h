// Dijkstra's algorithm over the cells of a grid (Dijkstra 1959).
//
// Guaranteed: the cost is the least there is, on every map and motion model. Of several goals it
// answers the one that costs least to reach, which A* does not.
//
// It has no ties to break. But with a tie-break other than none A* keeps its open list in strict
// order, which costs several times as much a cell; Dijkstra then does the same, so that a
// comparison of the two is not one of their open lists.
#pragma once

#include <vector>

#include "grid_path_planner/planners/a_star_options.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/astar/best_first_search.h"
#include "planners/astar/bucket_search.h"

namespace grid_path_planner::planners {

class Dijkstra : public Planner {
 public:
  static PlannerTraits declaredTraits();

  explicit Dijkstra(TieBreak tie_break = TieBreak::NONE);

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

 private:
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const std::vector<grid::CellRect>& changed, const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

  bool strictly_ordered_;
  BucketSearch by_buckets_;  // one of the two is used
  BestFirstSearch in_order_;
};

}  // namespace grid_path_planner::planners
