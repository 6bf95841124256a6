// Incremental A* for replanning while the vehicle drives: the goal stays, the start moves, and the map
// changes a little between two plans.
//
//   IncrementalAStar planner;
//   planner.prepare(map, stop);
//   planner.search({start, {goal}}, stop);           // a whole search, backwards from the goal
//   planner.update(changed_map, {changed}, stop);
//   planner.search({moved_start, {goal}}, stop);     // a search around the change
//
// The g-values of the first search are kept (backward_search_tree.h). Where the start's path is
// still valid and no cost decrease can improve it, it is the answer. Otherwise A* searches from the
// start as far as the changes reach (repair_search.h) with the kept g-values as its heuristic: it
// expands no more cells than A* with the octile heuristic, mostly a few hundred. Cost decreases are
// propagated through the g-values as far as they may matter. Costs decide how far that is, never a
// clock.
//
// Where a path costs more than the tree's keys can hold, 3.2 million cell lengths x weight, a_star
// answers until the next prepare().
//
// Guaranteed: the least cost, exactly, on every map and motion model. Not guaranteed: which of
// several least-cost paths is found, as that depends on earlier plans. A single plan for a new goal
// takes longer than a_star's: choose this planner for replanning only.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "grid_path_planner/planners/planner.h"
#include "planners/astar/a_star.h"
#include "planners/core/move_pruning.h"
#include "planners/replanning/backward_search_tree.h"

namespace grid_path_planner::planners {

class IncrementalAStar : public Planner {
 public:
  static PlannerTraits declaredTraits();

  IncrementalAStar();

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

 private:
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const std::vector<grid::CellRect>& changed, const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

  base::Status planByTree(const SearchRequest& request, SearchResult& result,
                          const base::StopToken& stop);
  void switchToAStar(const base::StopToken& stop);

  MovePruning moves_;
  std::optional<BackwardSearchTree> tree_;
  std::unique_ptr<AStar> a_star_;  // instead of both
};

}  // namespace grid_path_planner::planners
