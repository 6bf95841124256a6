// The least-cost ways to one goal, kept from plan to plan while the map changes and the start
// moves: a best-first search backwards from the goal, whose labels stay good as estimates.
//
//   GoalTree tree;
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

#include "grid_path_planner/search/detour_search.h"
#include "grid_path_planner/search/goal_labels.h"
#include "grid_path_planner/search/planner.h"
#include "grid_path_planner/search/rising_keys.h"
#include "grid_path_planner/search/search_key.h"
#include "grid_path_planner/search/waiting_cells.h"

namespace grid_path_planner {

class GoalTree {
 public:
  GoalTree() = default;
  GoalTree(const GoalTree&) = delete;
  GoalTree& operator=(const GoalTree&) = delete;

  // What grows with a search excluded: what waits, and its detours.
  static std::size_t bytesFor(const GridGeometry& geometry) {
    return GoalLabels::bytesFor(geometry);
  }

  // Forgets the tree. `moves` are those of the map of every call, and outlive this.
  void prepare(const CostGrid& map, const Moves& moves);

  // `after` differs from `before`, of which everything else here was told, only inside `changed`.
  void update(const CostGrid& before, const CostGrid& after, const CellRect& changed);

  // FOUND or UNREACHABLE.
  //
  // Forgets the tree and makes one for `goal`: searches until the least-cost way from `start` is
  // known, then labels `ahead` times as many cells more, so that later plans need not. Both are
  // passable. Puts what it does into `result`: cells and cost where FOUND, statistics, and the
  // cells it took where `record` asks for them. Throws Stopped, and leaves no tree then, and
  // CostOverflow where only ways were seen that are too dear.
  Status begin(const CostGrid& map, Cell goal, Cell start, double ahead, bool record,
               PlanResult& result, const StopToken& stop);
  // Whether a tree for `goal` is there that can be used on `map`, and is worth it: where the
  // detours took twice as many cells as the tree, it is time for another one.
  bool serves(const CostGrid& map, Cell goal) const;

  // The least-cost way from `start`, by as much of a search as the changes ask for. Throws as
  // begin(), and goes on at the next call. Precondition: serves().
  Status plan(const CostGrid& map, Cell start, bool record, PlanResult& result,
              const StopToken& stop);

  // Of what waits, and of the last detour.
  std::size_t searchBytes() const { return waiting_.bytes() + detour_.bytes(); }

 private:
  using Index = GoalLabels::Index;
  using State = GoalLabels::State;

  void setRoot(const CostGrid& map, Cell goal, Cell start);

  // wait(index) puts a cell that got a label where it waits.
  template <class Wait>
  void expand(Index index, Statistics& counts, const Wait& wait);
  template <class Wait>
  void relax(Index from, Index to, std::uint32_t step, Statistics& counts, const Wait& wait);
  // Expands what waits with keys below bound(), which may fall meanwhile, at most `limit` cells;
  // lowered(index) is told of every cell that got a label or a lower one. How many it expanded.
  template <class Bound, class Lowered>
  std::uint64_t advance(const Bound& bound, const Lowered& lowered, std::uint64_t limit,
                        bool record, PlanResult& result, StopPoll& poll);
  void takeDearer(const CellRect& rect);
  void takeCheaper(const CellRect& rect);
  void compare(Index index, std::uint32_t step);
  // The cell's neighbour by `step` may take a better way.
  void wake(Index index, std::uint32_t step);
  // Whether the start lies on the last way and nothing changed that since: what is left of it is
  // the answer then.
  bool keepsTheWay(const CostGrid& map, PlanResult& result);
  Status unreachable() const;

  GoalLabels labels_;
  DetourSearch detour_;
  RisingKeys keys_;
  WaitingCells waiting_;
  bool begun_ = false;
  bool too_dear_ = false;  // a label was left out that the keys do not hold
  Cell goal_;
  // The last one found; none where it got dearer since, or anything got cheaper.
  std::vector<Cell> way_;
  ExactCost way_cost_;
  std::uint64_t expanded_ = 0;            // by the tree
  std::uint64_t detoured_ = 0;            // and by detours since it was begun
  SearchKey sound_below_ = kInfiniteKey;  // labels below this are supported, all the way
};

}  // namespace grid_path_planner
