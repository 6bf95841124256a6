// Best-first search in strict order, for A* and Dijkstra with a tie-break: it expands the open cell
// with the least f-value, relaxes its steps and re-opens cells that get cheaper.
//
// The state is 12 bytes a cell in flat arrays: the key of the g-value, and a word with the query's
// stamp (stamped_array.h), the step that led to the cell and whether it is closed. The open list is
// a binary heap with lazy deletion. Cells that get cheaper after their expansion are re-opened, so
// an admissible heuristic is enough for an optimal path.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#include "base/zeroed_array.h"
#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/core/binary_heap.h"
#include "planners/core/keys.h"
#include "planners/core/stamped_array.h"
#include "planners/core/steps.h"

namespace grid_path_planner::planners {

class BestFirstSearch {
 public:
  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return geometry.size() * (sizeof(SearchKey) + sizeof(std::uint32_t) + sizeof(std::uint8_t));
  }

  // Throws Stopped.
  void prepare(const costmap::CostGrid& map, const base::StopToken& stop);
  void update(const costmap::CostGrid& map, const std::vector<grid::CellRect>& changed,
              const base::StopToken& stop);

  // Cells are expanded in the order of f, those of equal f in the order of tie.
  struct Priority {
    SearchKey f;
    SearchKey tie;
  };

  // Searches from `start` until isGoal(index) is true of the cell that is expanded.
  // priorityOf(g, cell) orders the open list. FOUND with cells and cost, or UNREACHABLE. Throws
  // Stopped and TooExpensive. Precondition: `map` is the prepared one and `start` is passable.
  template <class IsGoal, class PriorityOf>
  SearchResult run(const costmap::CostGrid& map, grid::Cell start, IsGoal&& isGoal,
                   PriorityOf&& priorityOf, bool record_expanded, const base::StopToken& stop);

 private:
  struct Entry {
    SearchKey f;
    SearchKey tie;
    std::uint32_t index;
  };
  struct Worse {
    bool operator()(const Entry& a, const Entry& b) const {
      return a.f != b.f ? a.f > b.f : a.tie > b.tie;
    }
  };

  static constexpr std::uint32_t kClosed = 1;
  static constexpr std::uint32_t kStepShift = 1;
  static constexpr std::uint32_t kQueryShift = 4;

  void beginQuery();
  bool generated(std::uint32_t index) const { return stamp_.wrote(words_[index]); }
  bool closed(std::uint32_t index) const { return (words_[index] & kClosed) != 0; }
  void write(std::uint32_t index, std::uint32_t step, SearchKey g) {
    words_[index] = stamp_.word() | step << kStepShift;
    costs_[index] = g;
  }
  std::vector<grid::Cell> pathTo(const costmap::CostGrid& map, std::uint32_t start,
                                 std::uint32_t goal) const;
  SearchResult finish(const costmap::CostGrid& map, std::uint32_t start, std::uint32_t goal,
                      SearchResult result) const;
  SearchResult withStatus(const costmap::CostGrid& map, base::Status status,
                          SearchResult result) const;

  StepMasks masks_;
  base::ZeroedArray<SearchKey> costs_;
  base::ZeroedArray<std::uint32_t> words_;
  BinaryHeap<Entry, Worse> open_;
  QueryStamp<std::uint32_t, kQueryShift> stamp_;
};

template <class IsGoal, class PriorityOf>
SearchResult BestFirstSearch::run(const costmap::CostGrid& map, grid::Cell start, IsGoal&& isGoal,
                                  PriorityOf&& priorityOf, bool record_expanded,
                                  const base::StopToken& stop) {
  const grid::GridGeometry& geometry = map.geometry();
  const costmap::CostGrid::Weight* weights = map.weights().values().data();
  const SearchKey diagonal = diagonalKey(map.motion().diagonal_cost);
  const std::uint32_t start_index = geometry.index(start).value();
  SearchResult result;
  base::Statistics& counts = result.statistics;
  base::StopPoll poll(stop);

  // 1. The start is the only open cell.
  beginQuery();
  write(start_index, 0, 0);
  const Priority first = priorityOf(SearchKey{0}, start);
  open_.push({first.f, first.tie, start_index});
  counts.generated = 1;

  while (!open_.empty()) {
    const base::StopReason reason = poll.ask();
    if (reason != base::StopReason::NONE)
      return withStatus(map, base::Stopped(reason).status(), result);
    counts.peak_open = std::max(counts.peak_open, open_.size());

    // 2. The open cell with the least f-value, unless it was expanded since it was pushed.
    const std::uint32_t from = open_.pop().index;
    if (closed(from)) continue;
    words_[from] |= kClosed;
    ++counts.expanded;
    if (record_expanded) result.expanded.emplace_back(from);
    if (isGoal(from)) return finish(map, start_index, from, result);

    // 3. Its steps.
    const SearchKey g = costs_[from];
    for (unsigned mask = masks_[from]; mask != 0; mask &= mask - 1) {
      const auto step = static_cast<std::uint32_t>(__builtin_ctz(mask));
      const auto to = static_cast<std::uint32_t>(from + masks_.offsets()[step]);
      const SearchKey length = step < 4 ? kStraightKey : diagonal;
      const SearchKey to_g = g + length * std::max(weights[from], weights[to]);
      const bool known = generated(to);
      if (known && costs_[to] <= to_g) continue;
      if (to_g > kLargestKey) throw TooExpensive();

      // 4. A cheaper path to a cell: open it, or re-open it.
      if (known && closed(to)) ++counts.reopened;
      write(to, step, to_g);
      const Priority priority = priorityOf(to_g, geometry.cell(grid::CellIndex(to)));
      open_.push({priority.f, priority.tie, to});
      ++counts.generated;
    }
  }
  return withStatus(map, base::Status::UNREACHABLE, result);
}

}  // namespace grid_path_planner::planners
