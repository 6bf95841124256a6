// What a tree of ways to one goal says of every cell: a label, the step that it came by, and
// whether the neighbours were told.
//
//   if (labels.state(index) != BackwardNodes::UNLABELLED && labels.consistent(index))
//     use(labels.g(index));
//
// A label is the cost of a way to the goal at the time when it was written. It holds still where
// every step of the way is supported: legal, and no dearer than the labels of its two ends differ.
// Labels are keys of kPackedScale. 8 bytes a cell; nothing is cleared between trees.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "grid_path_planner/base/zeroed_array.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/planners/cell_of_index.h"
#include "grid_path_planner/planners/keys.h"
#include "grid_path_planner/planners/move_pruning.h"
#include "grid_path_planner/planners/stamped_array.h"

namespace grid_path_planner::planners {

class BackwardNodes {
 public:
  using Index = std::uint32_t;
  static constexpr SearchKey kLargest = kPackedScale.largest;
  // Of a cell that is CLOSED its neighbours know the label; of one that is OPEN not yet.
  enum State : std::uint32_t { UNLABELLED, OPEN, CLOSED };

  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return geometry.size() * sizeof(Word);
  }

  // `moves` are those of the map of every call, and outlive this.
  void prepare(const costmap::CostGrid& map, const MovePruning& moves);
  // Forgets all labels but the root's, which is 0.
  void begin(Index root);
  // To be called before anything that asks for steps, after every change of the map.
  void setMap(const costmap::CostGrid& map) { weights_ = map.weights().values().data(); }

  // Of the cells of `rect`, which are asked for next. Precondition: it lies in the map.
  void prefetchRows(const grid::CellRect& rect) const;

  Index root() const { return root_; }
  const grid::GridGeometry& geometry() const { return geometry_; }
  grid::Cell cell(Index index) const { return cell_of_(index); }

  bool known(Index index) const { return stamp_.wrote(words_[index]); }
  State state(Index index) const {
    return known(index) ? static_cast<State>(words_[index] & kStateMask) : UNLABELLED;
  }
  // Preconditions from here on: the cell has a label.
  SearchKey g(Index index) const { return words_[index] >> kLabelShift & kLargest; }
  std::uint32_t stepOf(Index index) const {
    return static_cast<std::uint32_t>(words_[index] >> kStepShift) & 7U;
  }
  // Where the way leads next. Precondition: not the root.
  Index next(Index index) const { return along(index, stepOf(index)); }
  bool consistent(Index index) const {
    const std::uint32_t step = stepOf(index);
    if ((stepsFrom(index) >> step & 1U) == 0) return index == root_;
    const Index next = along(index, step);
    return g(index) >= g(next) + stepKey(index, next, step) || index == root_;
  }

  // Precondition: the label is at most kLargest.
  void set(Index index, SearchKey label, std::uint32_t step, State state) {
    words_[index] = stamp_.word() | label << kLabelShift | Word{step} << kStepShift | Word{state};
  }
  void setState(Index index, State state) {
    words_[index] = (words_[index] & ~kStateMask) | Word{state};
  }

  const MovePruning& moves() const { return *moves_; }
  // The steps that the map allows, bit n for step n of steps.h; and where they lead.
  std::uint32_t stepsFrom(Index index) const { return moves_->from(index); }
  Index along(Index index, std::uint32_t step) const {
    return static_cast<Index>(index + offsets_[step]);
  }
  costmap::CostGrid::Weight weight(Index index) const { return weights_[index]; }
  // What a step between neighbours costs.
  SearchKey stepKey(Index from, Index to, std::uint32_t step) const {
    return stepLength(step) * std::max(weights_[from], weights_[to]);
  }
  // Where all weighs 1.
  SearchKey stepLength(std::uint32_t step) const {
    return step < 4 ? kPackedScale.straight : diagonal_step_;
  }

 private:
  // 16 bits of the tree's number, 43 of label, 3 of the step towards the goal, 2 of state.
  using Word = std::uint64_t;
  static constexpr unsigned kStepShift = 2;
  static constexpr unsigned kLabelShift = 5;
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

// The step back.
constexpr std::uint32_t oppositeStep(std::uint32_t step) {
  return step ^ 2U;
}

}  // namespace grid_path_planner::planners
