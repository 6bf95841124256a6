// The backward search tree of the goal that a vehicle drives to, kept beside a planner of single plans:
// after a small change of the map it answers where that takes less than a new search.
//
//   KeptSearchTree tree;
//   SearchResult result;
//   if (tree.search(map, request, result, stop)) return result;
//   result = planner.search(request, stop);
//   if (result.status == Status::FOUND) tree.searched(map, request, result.statistics.expanded);
//   tree.update(before, after, changed, stop);   // follow every change of the map
//   if (tree.wanted(map)) tree.make(map, stop);  // in idle time
//
// A tree is wanted for a goal that was searched for twice, on maps of two revisions. It takes several
// times as long as a search, so it is made in idle time, and repaired there once its answers took more than
// a small share of a search: what is out of date for one plan is so for the next one, too. Idle times add
// up: a making or repair that is stopped goes on in the next one, on the map of then. Meanwhile there is no
// tree to ask. An answer that would take more than half of a search is given up, and half as much each time
// in a row. After trees that answered nothing, as where much of the map changes each time, ever more
// searches go by before the next one is made, 31 at most: idle time is processor time, too.
//
// Guaranteed: the cost found is the least there is, exactly, whatever was stopped, given up or out of
// memory before. Not guaranteed: which of several least-cost paths is found.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "grid_path_planner/planners/planner.h"
#include "planners/core/move_pruning.h"
#include "planners/replanning/backward_search_tree.h"

namespace grid_path_planner::planners {

class KeptSearchTree {
 public:
  // Without the open list and what a repair takes.
  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return BackwardSearchTree::bytesFor(geometry) + geometry.size();
  }

  // Frees all memory and forgets the goal.
  void release();
  // Whether memory is held.
  bool held() const { return tree_ != nullptr; }

  // A search of `cells` expansions found a path on `map`.
  void searched(const costmap::CostGrid& map, const SearchRequest& request, std::uint64_t cells);
  // `after` differs from `before`, the map of the last call, only inside `changed`, disjoint rectangles.
  // Throws Stopped; then release() must be called.
  void update(const costmap::CostGrid& before, const costmap::CostGrid& after,
              const std::vector<grid::CellRect>& changed, const base::StopToken& stop);

  // Whether `result` is the answer: FOUND or UNREACHABLE. Else there is no tree that answers soon
  // enough, and what was tried is added to its statistics and expanded cells. Throws Stopped.
  // Precondition: start and goal are passable.
  bool search(const costmap::CostGrid& map, const SearchRequest& request, SearchResult& result,
              const base::StopToken& stop);

  bool wanted(const costmap::CostGrid& map) const;
  // Makes or repairs it, but where there is too little memory or paths cost too much. Throws Stopped, within
  // a fraction of a millisecond, and goes on at the next call.
  // Precondition: wanted().
  void make(const costmap::CostGrid& map, const base::StopToken& stop);

 private:
  bool tryToSearch(const costmap::CostGrid& map, const SearchRequest& request, SearchResult& result,
                   const base::StopToken& stop, std::uint64_t most);
  bool stale(const costmap::CostGrid& map) const;
  void prepare(const costmap::CostGrid& map);
  void lookUpMoves(const costmap::CostGrid& map, const base::StopToken& stop);
  void goOnMaking(const costmap::CostGrid& map, const base::StopToken& stop);
  void begin(const costmap::CostGrid& map, const base::StopToken& stop);
  void drop();
  void giveUp();
  void notePayOff(bool same_goal);

  MovePruning moves_;
  std::unique_ptr<BackwardSearchTree> tree_;
  int rows_ = 0;         // whose moves are looked up
  bool making_ = false;  // or repairing: begun, and not done
  // Expansions since the tree was last right, which repairing it might have saved.
  std::uint64_t lost_ = 0;
  unsigned given_up_ = 0;    // answers in a row
  bool impossible_ = false;  // to make one

  // Of the goal that was asked for last:
  bool asked_ = false;
  grid::Cell goal_;
  grid::Cell start_;            // of the last question
  std::uint64_t revision_ = 0;  // of the map at the last search
  std::uint64_t effort_ = 0;    // cells that it expanded
  bool again_ = false;          // searched for on maps of two revisions

  enum class Use { NONE, MADE, ANSWERED };
  Use use_ = Use::NONE;   // of a tree, since the last search without it
  unsigned in_vain_ = 0;  // trees in a row that answered nothing
  unsigned to_wait_ = 0;  // searches, before another is made
};

}  // namespace grid_path_planner::planners
