// A backward search tree: the least-cost paths to one goal, kept from plan to plan while the map
// changes and the start moves.
//
//   BackwardSearchTree tree;
//   tree.prepare(map, moves);                             // moves.update() before tree.update()
//   tree.build(map, goal, start, extra, false, result, stop);
//   tree.update(old_map, new_map, changed);               // cells of `changed` have new weights
//   tree.plan(new_map, moved_start, false, result, stop);  // of no more cells than that, if asked for
//   tree.beginRepair(new_map, moved_start, stop);         // in idle time: later plans search less
//   tree.grow(new_map, moved_start, extra, false, result, stop);
//
// plan() returns the rest of the last path where the start is on it, no cost on it increased and no
// cost anywhere decreased. It repairs no cost increases elsewhere: a g-value whose path is no
// longer consistent remains a lower bound, and the repair search (repair_search.h) goes around the
// change. Cost decreases are propagated as D* Lite does it (Koenig & Likhachev, AAAI 2002): the
// inconsistent cells are in the open list, together with the frontier of the tree, by the keys
// g-value + heuristic (d_star_keys.h, tiled_open_list.h). Cells whose keys are above the cost of the
// path found are not expanded. A repair removes the g-values that are too low (outdated_cells.h) and grows
// the tree into their cells again.
//
// Invariant: where a cell's g-value exceeds that of a neighbour plus the step, or is missing, the
// neighbour is OPEN.
//
// Guaranteed: the cost found is the least there is, exactly. A plan() that was stopped, or would have
// taken too many cells, continues at the next call; so do grow() and beginRepair(), and update() may
// come in between. Not guaranteed: which of several least-cost paths is found; that depends on earlier calls.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "grid_path_planner/planners/planner.h"
#include "planners/core/bucket_queue.h"
#include "planners/core/keys.h"
#include "planners/replanning/backward_nodes.h"
#include "planners/replanning/d_star_keys.h"
#include "planners/replanning/outdated_cells.h"
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
  // The same in parts: begin(), and grow() until it returns. A grow() that throws Stopped goes on at the
  // next call where it was, also after update() and for another start. Precondition of grow(): growing().
  void begin(const costmap::CostGrid& map, grid::Cell goal, grid::Cell start);
  void grow(const costmap::CostGrid& map, grid::Cell start, double extra, bool record,
            SearchResult& result, const base::StopToken& stop);
  // Whether a tree for `goal` that is valid on `map` was begun and is not built yet.
  bool growing(const costmap::CostGrid& map, grid::Cell goal) const;
  // Whether the tree is for `goal` and its keys hold on `map`.
  bool validOn(const costmap::CostGrid& map, grid::Cell goal) const;

  // Whether there is a tree for `goal` that is valid on `map` and still pays: once repair searches
  // have expanded twice as many cells as the tree, a new tree is better.
  bool usableFor(const costmap::CostGrid& map, grid::Cell goal) const;

  // The least-cost path from `start`; searches only as far as the changes require. Throws as
  // build(), and TooManyCells where more than `most` cells would have to be expanded, and continues at
  // the next call. Precondition: usableFor().
  base::Status plan(const costmap::CostGrid& map, grid::Cell start, bool record,
                    SearchResult& result, const base::StopToken& stop,
                    std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

  // Finds the g-values that cost increases made too low, and those that were computed from them;
  // grow() then computes them anew, so that later plans have less to search. Throws Stopped, and goes
  // on at the next call. Precondition: usableFor().
  void beginRepair(const costmap::CostGrid& map, grid::Cell start, const base::StopToken& stop);

  // Of the open list, the last repair search and what is outdated.
  std::size_t searchBytes() const {
    return open_.bytes() + repair_search_.bytes() + outdated_.bytes();
  }

 private:
  using Index = BackwardNodes::Index;
  using State = BackwardNodes::State;

  bool grownEnough(Index from, double extra);
  void keepFrontier(Index from, base::StopPoll& poll);
  void removeOutdated(base::StopPoll& poll);
  void openAround(Index index);
  void open(Index index);

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
  BucketQueue growing_;  // open cells until it is built
  bool begun_ = false;
  bool built_ = false;
  bool repairing_ = false;  // growing, and not from its root
  bool grown_ = false;      // what is left to do is to move growing_ into open_
  OutdatedCells outdated_;
  std::size_t removed_ = 0, opened_ = 0;  // of these: removed, and their neighbours opened
  bool overflowed_ = false;               // a g-value was left out that keys cannot hold
  grid::Cell goal_;
  // The last one found; empty after a cost increase on it or any cost decrease.
  std::vector<grid::Cell> path_;
  costmap::ExactCost path_cost_;
  std::uint64_t expanded_ = 0;                 // until it was built
  std::uint64_t limit_ = 0;                    // of these, once the start was reached
  std::uint64_t repaired_ = 0;                 // expanded by the repair that was begun last
  std::uint64_t to_repair_ = 0;                // cells that were outdated then
  std::uint64_t repair_expanded_ = 0;          // by repair searches since
  SearchKey consistent_below_ = kInfiniteKey;  // paths from g-values below it are consistent
};

}  // namespace grid_path_planner::planners
