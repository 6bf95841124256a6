// A backward search tree: the least-cost paths to one goal, kept from plan to plan while the map
// changes and the start moves.
//
//   BackwardSearchTree tree;
//   tree.prepare(map, moves);                             // moves.update() before tree.update()
//   tree.build(map, goal, start, extra, false, result, stop);
//   tree.update(old_map, new_map, changed);               // cells of `changed` have new weights
//   tree.plan(new_map, moved_start, false, result, stop);  // of no more cells than that, if asked for
//
// plan() returns the rest of the last path where the start is on it, no cost on it increased and no
// cost anywhere decreased. Cost increases elsewhere are not repaired: a g-value whose path is no
// longer consistent remains a lower bound, and the repair search (repair_search.h) goes around the
// change. Cost decreases are propagated as D* Lite does it (Koenig & Likhachev, AAAI 2002): the
// inconsistent cells are in the open list, together with the frontier of the tree, by the keys
// g-value + heuristic (d_star_keys.h, tiled_open_list.h). Cells whose keys are above the cost of the
// path found are not expanded.
//
// Invariant: where a cell's g-value exceeds that of a neighbour plus the step, or is missing, the
// neighbour is OPEN.
//
// Guaranteed: the cost found is the least there is, exactly. A plan() that was stopped, or would have
// taken too many cells, continues at the next call. Not guaranteed: which of several least-cost paths is found; that depends on earlier calls.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "grid_path_planner/planners/planner.h"
#include "planners/core/keys.h"
#include "planners/replanning/backward_nodes.h"
#include "planners/replanning/d_star_keys.h"
#include "planners/replanning/repair_search.h"
#include "planners/replanning/tiled_open_list.h"

namespace grid_path_planner::planners {

class BackwardSearchTree {
 public:
  // Of build(): so many times as many cells as its first plan needs, for a goal that stays.
  static constexpr double kUsualExtra = 3.0;

  BackwardSearchTree() = default;
  BackwardSearchTree(const BackwardSearchTree&) = delete;
  BackwardSearchTree& operator=(const BackwardSearchTree&) = delete;

  // Without the open list and the repair search, which grow with a search.
  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return BackwardNodes::bytesFor(geometry);
  }

  // Removes the tree. `moves` are always those of the present map, and outlive this.
  void prepare(const costmap::CostGrid& map, const MovePruning& moves);

  // `after` differs from `before`, the map of the last call, only inside `changed`.
  void update(const costmap::CostGrid& before, const costmap::CostGrid& after,
              const grid::CellRect& changed);

  // Replaces the tree by one for `goal`: searches until the least-cost path from `start` is known,
  // then expands `extra` times as many cells more, so that later plans need not. FOUND or
  // UNREACHABLE. Writes into `result`: cells and cost where FOUND, statistics and, with `record`,
  // the expanded cells. Throws Stopped, and leaves no tree then, and TooExpensive where all paths
  // found are too expensive. Precondition: both cells are passable.
  base::Status build(const costmap::CostGrid& map, grid::Cell goal, grid::Cell start, double extra,
                     bool record, SearchResult& result, const base::StopToken& stop);
  // Whether there is a tree for `goal` that is valid on `map` and still pays: once repair searches
  // have expanded twice as many cells as the tree, a new tree is better.
  bool usableFor(const costmap::CostGrid& map, grid::Cell goal) const;

  // The least-cost path from `start`; searches only as far as the changes require. Throws as
  // build(), and TooManyCells where more than `most` cells would have to be expanded, and continues at
  // the next call. Precondition: usableFor().
  base::Status plan(const costmap::CostGrid& map, grid::Cell start, bool record,
                    SearchResult& result, const base::StopToken& stop,
                    std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

  // Of the open list and the last repair search.
  std::size_t searchBytes() const { return open_.bytes() + repair_search_.bytes(); }

 private:
  using Index = BackwardNodes::Index;
  using State = BackwardNodes::State;

  void setRoot(const costmap::CostGrid& map, grid::Cell goal, grid::Cell start);

  // push(index) inserts a cell with a new g-value into the open list.
  template <class Push>
  void expand(Index index, base::Statistics& counts, const Push& push);
  template <class Push>
  void relax(Index from, Index to, std::uint32_t step, base::Statistics& counts, const Push& push);
  // Expands open cells with keys below bound(), which may decrease meanwhile, at most `limit` of
  // them. Calls lowered(index) for every cell whose g-value is new or decreased. Returns how many
  // cells it expanded.
  template <class Bound, class Lowered>
  std::uint64_t advance(const Bound& bound, const Lowered& lowered, std::uint64_t limit,
                        bool record, SearchResult& result, base::StopPoll& poll);
  void onCostIncrease(const grid::CellRect& rect);
  void onCostDecrease(const grid::CellRect& rect);
  // Opens the end of the step whose g-value may lower the other end's.
  void checkStep(Index index, std::uint32_t step);
  // The cell's neighbour by `step` may be reached at a lower cost.
  void markInconsistent(Index index, std::uint32_t step);
  // Whether the start is on the last path and that is still the least-cost one: the rest of it is
  // the answer then.
  bool lastPathHolds(const costmap::CostGrid& map, SearchResult& result);
  base::Status unreachable() const;

  BackwardNodes nodes_;
  RepairSearch repair_search_;
  DStarKeys keys_;
  TiledOpenList open_;
  bool built_ = false;
  bool overflowed_ = false;  // a g-value was left out that keys cannot hold
  grid::Cell goal_;
  // The last one found; empty after a cost increase on it or any cost decrease.
  std::vector<grid::Cell> path_;
  costmap::ExactCost path_cost_;
  std::uint64_t expanded_ = 0;                 // by build()
  std::uint64_t repair_expanded_ = 0;          // by repair searches since
  SearchKey consistent_below_ = kInfiniteKey;  // paths from g-values below it are consistent
};

}  // namespace grid_path_planner::planners
