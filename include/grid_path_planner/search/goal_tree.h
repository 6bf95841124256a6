// The least-cost ways to one goal, kept from plan to plan while the map changes and the start
// moves: a best-first search backwards from the goal whose tree is repaired instead of made anew.
//
//   GoalTree tree;
//   tree.prepare(map, moves);                             // moves.update() before tree.update()
//   tree.begin(map, goal, start, ahead, false, result, stop);
//   tree.update(old_map, new_map, changed, stop);         // cells of `changed` have new weights
//   tree.repair(new_map, moved_start, limit, false, result, stop);
//
// This is D* Lite (Koenig & Likhachev, AAAI 2002, in its optimised version) with one label a cell
// instead of two. A cell is unlabelled, open (its label is the cost of a way to the goal, its
// neighbours do not know yet), closed (they do) or doubtful (its way got dearer; the label is a
// lower bound). What is open or doubtful waits in a queue by label + estimate of the way from the
// start. A doubtful cell that is taken out passes the doubt on to those whose way leads through it
// and takes the best way its closed neighbours offer. Doubts below the cost before are settled
// first, all together. Nothing is done for cells that wait behind
// the cost of the way that is found, so doubt about ways that lead elsewhere costs nothing. When
// the start moves, the queue's keys stay lower bounds once new ones are raised by the estimate
// between the old and the new start.
//
// Guaranteed: the cost found is the least there is, exactly. Stopped or out of its limit, it goes
// on where it was at the next call. Not guaranteed: which of equally cheap ways is found; that
// depends on the calls before.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "grid_path_planner/base/zeroed_array.h"
#include "grid_path_planner/search/cell_of_index.h"
#include "grid_path_planner/search/moves.h"
#include "grid_path_planner/search/patient_queue.h"
#include "grid_path_planner/search/planner.h"
#include "grid_path_planner/search/search_key.h"

namespace grid_path_planner {

class GoalTree {
 public:
  // The queue excluded, which grows with the search's border.
  static std::size_t bytesFor(const GridGeometry& geometry) {
    return geometry.size() * (sizeof(SearchKey) + sizeof(std::uint32_t));
  }

  // Forgets the tree. `moves` are those of the map of every call, and outlive this.
  void prepare(const CostGrid& map, const Moves& moves);

  // `after` differs from `before`, of which everything else here was told, only inside `changed`.
  // Throws CostOverflow: forget() it then.
  void update(const CostGrid& before, const CostGrid& after, const CellRect& changed);

  enum class Outcome { FOUND, UNREACHABLE, LIMIT };

  // Forgets the tree and makes one for `goal`: searches until the least-cost way from `start` is
  // known, then labels `ahead` times as many cells more, so that repairs need not. Both are
  // passable. Puts what it does into `result`: cells and cost where FOUND, statistics, and the
  // cells it took where `record` asks for them. Throws Stopped and CostOverflow, and leaves no tree
  // then.
  Outcome begin(const CostGrid& map, Cell goal, Cell start, std::uint64_t ahead, bool record,
                PlanResult& result, const StopToken& stop);
  void forget() { begun_ = false; }
  // Whether a tree for `goal` is there that can be repaired on `map`.
  bool serves(const CostGrid& map, Cell goal) const;

  // Repairs the tree as far as the least-cost way from `start` takes. LIMIT where that is more than
  // `limit` cells; then the next call goes on. Throws Stopped, and CostOverflow: forget() it then.
  Outcome repair(const CostGrid& map, Cell start, std::uint64_t limit, bool record,
                 PlanResult& result, const StopToken& stop);

  // The cost of the way from `start`, as a key; what it was where that is not known any more.
  SearchKey labelOf(Cell start) const { return labels_[geometry_.index(start).value()]; }

  std::size_t queueBytes() const { return queue_.bytes(); }

 private:
  using Index = std::uint32_t;
  enum State : std::uint32_t { UNLABELLED, OPEN, CLOSED, DOUBTFUL };

  // Of equal keys doubtful cells come first, so that nobody believes them; then those nearest to
  // the start.
  static constexpr std::uint32_t kDoubtFirst = ~std::uint32_t{0};

  // A word: number of the tree, step towards the goal, state.
  static constexpr std::uint32_t kStepShift = 2;
  static constexpr std::uint32_t kTreeShift = 5;
  static constexpr std::uint32_t kStateMask = (1U << kStepShift) - 1;

  State state(Index index) const {
    const std::uint32_t word = words_[index];
    return word >> kTreeShift == tree_ ? static_cast<State>(word & kStateMask) : UNLABELLED;
  }
  std::uint32_t stepOf(Index index) const { return words_[index] >> kStepShift & 7U; }
  void set(Index index, std::uint32_t step, State state) {
    words_[index] = tree_ << kTreeShift | step << kStepShift | state;
  }
  void setState(Index index, State state) { words_[index] = (words_[index] & ~kStateMask) | state; }
  Index along(Index index, std::uint32_t step) const {
    return static_cast<Index>(index + moves_->offsets()[step]);
  }
  // What a step between neighbours costs.
  SearchKey stepKey(Index from, Index to, std::uint32_t step) const {
    return (step < 4 ? kStraightKey : diagonal_step_) * std::max(weights_[from], weights_[to]);
  }
  SearchKey estimate(Cell from, Cell to) const {
    const auto columns = static_cast<SearchKey>(std::abs(from.column - to.column));
    const auto rows = static_cast<SearchKey>(std::abs(from.row - to.row));
    const SearchKey both = std::min(columns, rows);
    return both * diagonal_ + (std::max(columns, rows) - both) * straight_;
  }
  SearchKey keyOf(Index index) const {
    return labels_[index] + estimate(cell_of_(index), start_) + raised_;
  }
  void push(Index index);
  // Whether the entry means anything still; its key brought up to date.
  bool renew(PatientQueue::Entry& entry) const;
  void moveStart(Cell start);

  void doubt(Index index);
  // Settles all doubts with keys up to `bound` together, those nearest to the goal first: what a
  // cell takes for its way is then no doubtful way. Returns how many, at most about `limit`.
  std::uint64_t sweep(SearchKey bound, std::uint64_t limit, bool record, PlanResult& result,
                      StopPoll& poll);
  struct Offered {
    SearchKey label = kInfiniteKey;
    std::uint32_t step = 0;
  };
  // The best way that closed neighbours offer; those whose own way leads through the cell are put
  // into followers_.
  Offered offeredTo(Index doubtful);
  void open(Index index, const Offered& way, Statistics& counts);
  // wait(index) puts a cell that was opened where it waits.
  template <class Wait>
  void expand(Index index, Statistics& counts, const Wait& wait);
  template <class Wait>
  void relax(Index from, Index to, std::uint32_t step, Statistics& counts, const Wait& wait);
  void settle(Index doubtful, Statistics& counts);
  void take(Index index, bool record, PlanResult& result);
  Outcome finish(const CostGrid& map, PlanResult& result) const;
  void setRoot(const CostGrid& map, Cell goal);
  void checkWayOf(Index index);
  // The way from `start` into path_, or the first doubtful cell on it.
  std::optional<Index> trace(Index start);

  GridGeometry geometry_;
  CellOfIndex cell_of_{GridGeometry(1, 1, 1.0)};
  const CostGrid::Weight* weights_ = nullptr;  // of the map of the present call
  SearchKey diagonal_step_ = 0;
  const Moves* moves_ = nullptr;
  ZeroedArray<SearchKey> labels_;
  ZeroedArray<std::uint32_t> words_;
  PatientQueue queue_;
  std::vector<Index> new_doubts_;  // of updates, not in queue_ yet
  struct Doubt {
    SearchKey label;
    Index index;
    friend bool operator<(const Doubt& a, const Doubt& b) { return a.label > b.label; }
  };
  std::vector<Doubt> doubts_;  // of the present sweep, a heap
  std::vector<Index> swept_;
  std::array<Index, 8> followers_;
  std::size_t following_ = 0;
  std::vector<Cell> path_;
  std::uint32_t tree_ = 0;
  bool begun_ = false;
  Cell goal_;
  Index root_ = 0;  // the goal's
  Cell start_;
  SearchKey raised_ = 0;  // what new keys are raised by, as the start moved
  // The estimate's straight and diagonal lengths, by the weight that was cheapest when it began.
  CostGrid::Weight scale_ = 0;
  SearchKey straight_ = 0;
  SearchKey diagonal_ = 0;
};

}  // namespace grid_path_planner
