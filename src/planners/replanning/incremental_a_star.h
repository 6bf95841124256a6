// Replanning for a vehicle on its way: the same goal, a start that moves along, a map that changes
// a little between two plans.
//
//   IncrementalAStar planner;
//   planner.prepare(map, stop);
//   planner.plan({start, {goal}}, stop);           // a whole search, backwards from the goal
//   planner.update(changed_map, changed, stop);
//   planner.plan({moved_start, {goal}}, stop);     // a search around the change
//
// The labels of the first search are kept (goal_tree.h). Where the map changed so that the way of
// the start still holds and none can be cheaper, it is the answer; else A* goes from the start as
// far as the changes reach (detour_search.h), with the labels as estimates: it expands no more
// cells than A* with an octile estimate does, for the most part a few hundred. What got cheaper is
// passed on in the labels as far as it may matter. How far that is, the costs decide, never a
// clock.
//
// Where a way costs more than the tree's labels hold, 3.2 million cell lengths x weight, a_star
// takes over until the next prepare().
//
// Guaranteed: the least cost, exactly, on every map and motion model. Not guaranteed: which of
// equally cheap paths, as that depends on the plans before. A single plan for a new goal takes
// longer than a_star's: without replanning this is not the planner to choose.
#pragma once

#include <memory>
#include <optional>

#include "grid_path_planner/planners/a_star.h"
#include "grid_path_planner/planners/move_pruning.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/replanning/backward_search_tree.h"

namespace grid_path_planner::planners {

class IncrementalAStar : public Planner {
 public:
  static PlannerTraits declaredTraits();

  IncrementalAStar();

  std::size_t bytesFor(const grid::GridGeometry& geometry) const override;

 protected:
  void doPrepare(const base::StopToken& stop) override;
  void doUpdate(const grid::CellRect& changed, const base::StopToken& stop) override;
  SearchResult doSearch(const SearchRequest& request, const base::StopToken& stop) override;

 private:
  static std::size_t treeBytes(const grid::GridGeometry& geometry);
  base::Status planByTree(const SearchRequest& request, SearchResult& result,
                          const base::StopToken& stop);
  void handOver(const base::StopToken& stop);

  MovePruning moves_;
  std::optional<BackwardSearchTree> tree_;
  std::unique_ptr<AStar> a_star_;  // instead of both
};

}  // namespace grid_path_planner::planners
