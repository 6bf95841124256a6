// The least-cost ways to one goal, kept from plan to plan while the map changes and the start
// moves: a best-first search backwards from the goal, whose labels stay good as estimates.
//
//   BackwardSearchTree tree;
//   tree.prepare(map, moves);                             // moves.update() before tree.update()
//   tree.begin(map, goal, start, ahead, false, result, stop);
//   tree.update(old_map, new_map, changed);               // cells of `changed` have new weights
//   tree.plan(new_map, moved_start, false, result, stop);
//
// Where the start is on the last way found, nothing got dearer there and nothing cheaper anywhere,
// the rest of that way is the answer. What got dearer elsewhere is not repaired: a label that a way
// no longer bears out is a lower bound still, and the search forward from the start
// (detour_search.h) goes around it. What got cheaper is passed on, as D* Lite does it (Koenig &
// Likhachev, AAAI 2002): cells whose neighbours may take a better way wait by label + estimate of
// the way from the start (rising_keys.h, waiting_cells.h), together with the border of the tree,
// and those behind the cost of the way that is found are never looked at.
//
// The invariant behind it all: where a label exceeds a neighbour's label and the step there, or is
// missing, the neighbour waits.
//
// Guaranteed: the cost found is the least there is, exactly. Stopped, it goes on where it was at
// the next call. Not guaranteed: which of equally cheap ways is found; that depends on the calls
// before.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/planners/keys.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/replanning/backward_nodes.h"
#include "planners/replanning/d_star_keys.h"
#include "planners/replanning/repair_search.h"
#include "planners/replanning/tiled_open_list.h"

namespace grid_path_planner::planners {

class BackwardSearchTree {
 public:
  BackwardSearchTree() = default;
  BackwardSearchTree(const BackwardSearchTree&) = delete;
  BackwardSearchTree& operator=(const BackwardSearchTree&) = delete;

  // What grows with a search excluded: what waits, and its detours.
  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return BackwardNodes::bytesFor(geometry);
  }

  // Forgets the tree. `moves` are those of the map of every call, and outlive this.
  void prepare(const costmap::CostGrid& map, const MovePruning& moves);

  // `after` differs from `before`, of which everything else here was told, only inside `changed`.
  void update(const costmap::CostGrid& before, const costmap::CostGrid& after,
              const grid::CellRect& changed);

  // FOUND or UNREACHABLE.
  //
  // Forgets the tree and makes one for `goal`: searches until the least-cost way from `start` is
  // known, then labels `ahead` times as many cells more, so that later plans need not. Both are
  // passable. Puts what it does into `result`: cells and cost where FOUND, statistics, and the
  // cells it took where `record` asks for them. Throws Stopped, and leaves no tree then, and
  // TooExpensive where only ways were seen that are too dear.
  base::Status begin(const costmap::CostGrid& map, grid::Cell goal, grid::Cell start, double ahead,
                     bool record, SearchResult& result, const base::StopToken& stop);
  // Whether a tree for `goal` is there that can be used on `map`, and is worth it: where the
  // detours took twice as many cells as the tree, it is time for another one.
  bool usableFor(const costmap::CostGrid& map, grid::Cell goal) const;

  // The least-cost way from `start`, by as much of a search as the changes ask for. Throws as
  // begin(), and goes on at the next call. Precondition: serves().
  base::Status plan(const costmap::CostGrid& map, grid::Cell start, bool record,
                    SearchResult& result, const base::StopToken& stop);

  // Of what waits, and of the last detour.
  std::size_t searchBytes() const { return open_.bytes() + repair_search_.bytes(); }

 private:
  using Index = BackwardNodes::Index;
  using State = BackwardNodes::State;

  void setRoot(const costmap::CostGrid& map, grid::Cell goal, grid::Cell start);

  // wait(index) puts a cell that got a label where it waits.
  template <class Wait>
  void expand(Index index, base::Statistics& counts, const Wait& wait);
  template <class Wait>
  void relax(Index from, Index to, std::uint32_t step, base::Statistics& counts, const Wait& wait);
  // Expands what waits with keys below bound(), which may fall meanwhile, at most `limit` cells;
  // lowered(index) is told of every cell that got a label or a lower one. How many it expanded.
  template <class Bound, class Lowered>
  std::uint64_t advance(const Bound& bound, const Lowered& lowered, std::uint64_t limit,
                        bool record, SearchResult& result, base::StopPoll& poll);
  void onCostIncrease(const grid::CellRect& rect);
  void onCostDecrease(const grid::CellRect& rect);
  void compare(Index index, std::uint32_t step);
  // The cell's neighbour by `step` may take a better way.
  void markInconsistent(Index index, std::uint32_t step);
  // Whether the start lies on the last way and nothing changed that since: what is left of it is
  // the answer then.
  bool lastPathHolds(const costmap::CostGrid& map, SearchResult& result);
  base::Status unreachable() const;

  BackwardNodes nodes_;
  RepairSearch repair_search_;
  DStarKeys keys_;
  TiledOpenList open_;
  bool begun_ = false;
  bool overflowed_ = false;  // a label was left out that the keys do not hold
  grid::Cell goal_;
  // The last one found; none where it got dearer since, or anything got cheaper.
  std::vector<grid::Cell> path_;
  costmap::ExactCost path_cost_;
  std::uint64_t expanded_ = 0;                 // by the tree
  std::uint64_t detoured_ = 0;                 // and by detours since it was begun
  SearchKey consistent_below_ = kInfiniteKey;  // labels below this are supported, all the way
};

}  // namespace grid_path_planner::planners
