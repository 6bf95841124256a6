// The loop that A* and Dijkstra share: expand the most promising cell, relax its steps, re-open
// what got cheaper.
//
// State is 12 bytes a cell in flat arrays: the key of the cost so far, and a word with the number
// of the query that wrote it, the step that led here and whether the cell is closed. A new query
// only raises its number, so nothing is cleared in proportion to the map. The open list is a binary
// heap with lazy deletion. Cells that get cheaper after their expansion are re-opened, so an
// admissible estimate is enough for an optimal answer.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#include "grid_path_planner/base/statistics.h"
#include "grid_path_planner/base/zeroed_array.h"
#include "grid_path_planner/planners/keys.h"
#include "grid_path_planner/planners/planner.h"
#include "grid_path_planner/planners/stamped_array.h"
#include "grid_path_planner/planners/steps.h"

namespace grid_path_planner::planners {

class BestFirstSearch {
 public:
  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return geometry.size() * (sizeof(SearchKey) + sizeof(std::uint32_t) + sizeof(std::uint8_t));
  }

  // Throws Stopped.
  void prepare(const costmap::CostGrid& map, const base::StopToken& stop);
  void update(const costmap::CostGrid& map, const grid::CellRect& changed,
              const base::StopToken& stop);

  enum class GoalTest { WHEN_EXPANDED, WHEN_GENERATED };

  struct Promise {
    SearchKey f;    // expanded in the order of f,
    SearchKey tie;  // then of this
  };

  // Searches from `start` until `isGoal(index)` holds of the cell that is expanded (or generated).
  // `promise(g, cell)` orders the open list. FOUND with cells and cost, or UNREACHABLE. Throws
  // Stopped and TooExpensive. Precondition: `map` is the prepared one and `start` is passable.
  template <class IsGoal, class PromiseOf>
  SearchResult run(const costmap::CostGrid& map, grid::Cell start, IsGoal&& isGoal,
                   PromiseOf&& promise, bool record_expanded, const base::StopToken& stop,
                   GoalTest goal_test = GoalTest::WHEN_EXPANDED);

 private:
  struct Entry {
    SearchKey f;
    SearchKey tie;
    std::uint32_t index;
  };
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      return a.f != b.f ? a.f > b.f : a.tie > b.tie;
    }
  };

  static constexpr std::uint32_t kClosed = 1;
  static constexpr std::uint32_t kStepShift = 1;
  static constexpr std::uint32_t kQueryShift = 4;

  void beginQuery();
  bool touched(std::uint32_t index) const { return stamp_.wrote(words_[index]); }
  bool closed(std::uint32_t index) const { return (words_[index] & kClosed) != 0; }
  void open(std::uint32_t index, std::uint32_t step, SearchKey g) {
    words_[index] = stamp_.word() | step << kStepShift;
    costs_[index] = g;
  }
  void push(const Entry& entry) {
    heap_.push_back(entry);
    std::push_heap(heap_.begin(), heap_.end(), Later());
  }
  Entry pop() {
    std::pop_heap(heap_.begin(), heap_.end(), Later());
    const Entry entry = heap_.back();
    heap_.pop_back();
    return entry;
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
  std::vector<Entry> heap_;
  QueryStamp<std::uint32_t, kQueryShift> stamp_;
};

template <class IsGoal, class PromiseOf>
SearchResult BestFirstSearch::run(const costmap::CostGrid& map, grid::Cell start, IsGoal&& isGoal,
                                  PromiseOf&& promise, bool record_expanded,
                                  const base::StopToken& stop, GoalTest goal_test) {
  const grid::GridGeometry& geometry = map.geometry();
  const costmap::CostGrid::Weight* weights = map.weights().values().data();
  const SearchKey diagonal = diagonalKey(map.motion().diagonal_cost);
  const std::uint32_t start_index = geometry.index(start).value();
  const bool when_generated = goal_test == GoalTest::WHEN_GENERATED;
  SearchResult result;
  base::Statistics& counts = result.statistics;
  base::StopPoll poll(stop);

  // 1. The start is the only open cell.
  beginQuery();
  open(start_index, 0, 0);
  const Promise first = promise(SearchKey{0}, start);
  push({first.f, first.tie, start_index});
  counts.generated = 1;
  if (when_generated && isGoal(start_index)) return finish(map, start_index, start_index, result);

  while (!heap_.empty()) {
    const base::StopReason reason = poll.ask();
    if (reason != base::StopReason::NONE)
      return withStatus(map, base::Stopped(reason).status(), result);
    counts.peak_open = std::max(counts.peak_open, heap_.size());

    // 2. The most promising one, unless it was expanded since it was put there.
    const std::uint32_t from = pop().index;
    if (closed(from)) continue;
    words_[from] |= kClosed;
    ++counts.expanded;
    if (record_expanded) result.expanded.emplace_back(from);
    if (!when_generated && isGoal(from)) return finish(map, start_index, from, result);

    // 3. Its steps.
    const SearchKey g = costs_[from];
    for (unsigned mask = masks_[from]; mask != 0; mask &= mask - 1) {
      const auto step = static_cast<std::uint32_t>(__builtin_ctz(mask));
      const auto to = static_cast<std::uint32_t>(from + masks_.offsets()[step]);
      const SearchKey length = step < 4 ? kStraightKey : diagonal;
      const SearchKey to_g = g + length * std::max(weights[from], weights[to]);
      const bool known = touched(to);
      if (known && costs_[to] <= to_g) continue;
      if (to_g > kLargestKey) throw TooExpensive();

      // 4. A cheaper way to a cell: open it, or open it again.
      if (known && closed(to)) ++counts.reopened;
      open(to, step, to_g);
      const Promise hope = promise(to_g, geometry.cell(grid::CellIndex(to)));
      push({hope.f, hope.tie, to});
      ++counts.generated;
      if (when_generated && isGoal(to)) return finish(map, start_index, to, result);
    }
  }
  return withStatus(map, base::Status::UNREACHABLE, result);
}

}  // namespace grid_path_planner::planners
