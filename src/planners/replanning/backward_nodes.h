// The nodes of a backward search tree: for every cell its g-value, the cost-to-go; the step towards
// the goal; and its state.
//
//   if (nodes.state(index) != BackwardNodes::NEW && nodes.consistent(index)) use(nodes.g(index));
//
// A g-value is the cost of a path to the goal at the time when it was written. It is still that
// cost where every cell of the path is consistent: the step is legal and costs no more than the
// g-values of its two ends differ. Keys are of kPackedScale. 8 bytes a cell; nothing is cleared
// between trees (stamped_array.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/zeroed_array.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/cell_of_index.h"
#include "planners/core/keys.h"
#include "planners/core/move_pruning.h"
#include "planners/core/stamped_array.h"

namespace grid_path_planner::planners {

class BackwardNodes {
 public:
  using Index = std::uint32_t;
  static constexpr SearchKey kLargest = kPackedScale.largest;
  // NEW: the cell has no g-value. CLOSED: it was expanded with its present one.
  enum State : std::uint32_t { NEW, OPEN, CLOSED };

  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return geometry.size() * sizeof(Word);
  }

  // `moves` are always those of the present map, and outlive this.
  void prepare(const costmap::CostGrid& map, const MovePruning& moves);
  // Makes all cells NEW but the root, whose g-value is 0.
  void reset(Index root);
  // To be called after every change of the map, before any function about steps.
  void setMap(const costmap::CostGrid& map) { weights_ = map.weights().values().data(); }

  // Prefetches the nodes of the cells of `rect`. Precondition: it lies in the map.
  void prefetchRows(const grid::CellRect& rect) const;

  Index root() const { return root_; }
  const grid::GridGeometry& geometry() const { return geometry_; }
  grid::Cell cell(Index index) const { return cell_of_(index); }

  bool known(Index index) const { return stamp_.wrote(words_[index]); }
  State state(Index index) const {
    return known(index) ? static_cast<State>(words_[index] & kStateMask) : NEW;
  }
  // Precondition of the following: the cell is not NEW.
  SearchKey g(Index index) const { return words_[index] >> kGShift & kLargest; }
  std::uint32_t stepOf(Index index) const {
    return static_cast<std::uint32_t>(words_[index] >> kStepShift) & 7U;
  }
  // The next cell towards the goal. Precondition: not the root.
  Index next(Index index) const { return along(index, stepOf(index)); }
  bool consistent(Index index) const {
    const std::uint32_t step = stepOf(index);
    if ((stepsFrom(index) >> step & 1U) == 0) return index == root_;
    const Index next = along(index, step);
    return g(index) >= g(next) + stepKey(index, next, step) || index == root_;
  }

  // Precondition: `g` is at most kLargest.
  void set(Index index, SearchKey g, std::uint32_t step, State state) {
    words_[index] = stamp_.word() | g << kGShift | Word{step} << kStepShift | Word{state};
  }
  void setState(Index index, State state) {
    words_[index] = (words_[index] & ~kStateMask) | Word{state};
  }

  // Makes it NEW.
  void remove(Index index) { words_[index] = 0; }

  const MovePruning& moves() const { return *moves_; }
  // The steps that the map allows, bit n for step n of steps.h; and the cell to which a step leads.
  std::uint32_t stepsFrom(Index index) const { return moves_->from(index); }
  Index along(Index index, std::uint32_t step) const {
    return static_cast<Index>(index + offsets_[step]);
  }
  costmap::CostGrid::Weight weight(Index index) const { return weights_[index]; }
  // The cost of a step between neighbours.
  SearchKey stepKey(Index from, Index to, std::uint32_t step) const {
    return stepLength(step) * std::max(weights_[from], weights_[to]);
  }
  // The cost of a step where both weights are 1.
  SearchKey stepLength(std::uint32_t step) const {
    return step < 4 ? kPackedScale.straight : diagonal_step_;
  }

 private:
  // 16 bits of the tree's stamp, 43 of g-value, 3 of the step towards the goal, 2 of state.
  using Word = std::uint64_t;
  static constexpr unsigned kStepShift = 2;
  static constexpr unsigned kGShift = 5;
  static constexpr unsigned kTreeShift = 48;
  static constexpr Word kStateMask = (Word{1} << kStepShift) - 1;

  grid::GridGeometry geometry_;
  CellOfIndex cell_of_{grid::GridGeometry(1, 1, 1.0)};
  const costmap::CostGrid::Weight* weights_ = nullptr;
  SearchKey diagonal_step_ = 0;
  const MovePruning* moves_ = nullptr;
  std::array<std::ptrdiff_t, 8> offsets_{};
  base::ZeroedArray<Word> words_;
  QueryStamp<Word, kTreeShift> stamp_;
  Index root_ = 0;
};

}  // namespace grid_path_planner::planners
