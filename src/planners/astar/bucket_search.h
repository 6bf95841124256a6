// The fast best-first search of A* and Dijkstra: it expands an open cell with nearly the least
// f-value, tries its moves and re-opens cells that get cheaper.
//
// The open list is a BucketQueue, whose order is approximate. The cost found is exact all the same:
// the search continues until no open cell has an f-value below the goal's cost. On maps of one
// weight, and inside areas of one weight, only natural moves are tried (move_pruning.h).
//
// The state is 9 bytes a cell, or 13 where a path may cost more than 43-bit keys can hold. The
// map's size and weights decide which; a query whose costs turn out too large is repeated with the
// other. A new query clears nothing in proportion to the map (stamped_array.h).
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "grid_path_planner/planners/planner.h"
#include "planners/core/bucket_queue.h"
#include "planners/core/cell_of_index.h"
#include "planners/core/keys.h"
#include "planners/core/move_pruning.h"
#include "planners/core/search_nodes.h"

namespace grid_path_planner::planners {

// The heuristic of Dijkstra's algorithm: 0.
inline auto noEstimate(const KeyScale&) {
  return [](grid::Cell, std::uint32_t) { return SearchKey{0}; };
}

class BucketSearch {
 public:
  // The larger of the two states.
  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return geometry.size() * (WideNodes::kBytes + sizeof(std::uint8_t));
  }

  // Throw Stopped.
  void prepare(const costmap::CostGrid& map, const base::StopToken& stop);
  void update(const costmap::CostGrid& map, const std::vector<grid::CellRect>& changed,
              const base::StopToken& stop);

  // Of the last query, in cell lengths x weight: what the search knows of the cost from its start to a
  // cell, exactly where the cell was closed; infinite where the cell was not generated.
  double costFromStart(std::uint32_t index) const {
    return packed_.size() > 0 ? costIn(packed_, index) : costIn(wide_, index);
  }

  // The moves of the prepared map.
  const MovePruning& moves() const { return moves_; }

  // A least-cost path from `start` to a cell for which isGoal(index) is true, if the heuristic is
  // admissible; at most e times the least cost if it is admissible but for a factor e.
  // estimateIn(scale) returns the heuristic: a function of (cell, index) whose result is a key of
  // that scale. FOUND with cells and cost, UNREACHABLE, TIMEOUT or CANCELLED. Throws TooExpensive.
  // Precondition: `map` is the prepared one and `start` is passable.
  template <class IsGoal, class EstimateIn>
  SearchResult run(const costmap::CostGrid& map, grid::Cell start, const IsGoal& isGoal,
                   const EstimateIn& estimateIn, bool record_expanded, const base::StopToken& stop);

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::uint32_t kTooExpensive = kNone - 1;

  // The goal that was found, kNone where there is none, kTooExpensive where keys cannot hold a cost.
  template <bool kUniform, class Nodes, class IsGoal, class Estimate>
  std::uint32_t search(Nodes& nodes, const costmap::CostGrid& map, grid::Cell start,
                       const IsGoal& isGoal, const Estimate& estimate, bool record_expanded,
                       base::StopPoll& poll, SearchResult& result);
  template <class Nodes, class IsGoal, class EstimateIn>
  std::uint32_t searchOn(Nodes& nodes, const costmap::CostGrid& map, grid::Cell start,
                         const IsGoal& isGoal, const EstimateIn& estimateIn, bool record_expanded,
                         base::StopPoll& poll, SearchResult& result);

  template <class Nodes>
  static double costIn(const Nodes& nodes, std::uint32_t index) {
    if (!nodes.generated(index)) return std::numeric_limits<double>::infinity();
    return double(nodes.cost(index)) / double(Nodes::kScale.straight);
  }
  static bool packedMaySuffice(const costmap::CostGrid& map);
  static unsigned bucketShift(const costmap::CostGrid& map, const KeyScale& scale);
  template <class Nodes>
  void makeNodes(Nodes& nodes, const costmap::CostGrid& map);
  template <class Nodes>
  void finish(const Nodes& nodes, const costmap::CostGrid& map, grid::Cell start,
              std::uint32_t goal, SearchResult& result) const;

  MovePruning moves_;
  PackedNodes packed_;  // one of the two has memory
  WideNodes wide_;
  BucketQueue open_;
};

template <class IsGoal, class EstimateIn>
SearchResult BucketSearch::run(const costmap::CostGrid& map, grid::Cell start, const IsGoal& isGoal,
                               const EstimateIn& estimateIn, bool record_expanded,
                               const base::StopToken& stop) {
  SearchResult result;
  base::StopPoll poll(stop);
  if (packedMaySuffice(map)) {
    wide_ = WideNodes();
    const std::uint32_t goal =
        searchOn(packed_, map, start, isGoal, estimateIn, record_expanded, poll, result);
    if (goal != kTooExpensive) return result;
  }
  packed_ = PackedNodes();
  const std::uint32_t goal =
      searchOn(wide_, map, start, isGoal, estimateIn, record_expanded, poll, result);
  if (goal == kTooExpensive) throw TooExpensive();
  return result;
}

template <class Nodes, class IsGoal, class EstimateIn>
std::uint32_t BucketSearch::searchOn(Nodes& nodes, const costmap::CostGrid& map, grid::Cell start,
                                     const IsGoal& isGoal, const EstimateIn& estimateIn,
                                     bool record_expanded, base::StopPoll& poll,
                                     SearchResult& result) {
  makeNodes(nodes, map);
  const auto estimate = estimateIn(Nodes::kScale);
  result.status = base::Status::UNREACHABLE;
  const std::uint32_t goal =
      map.uniform()
          ? search<true>(nodes, map, start, isGoal, estimate, record_expanded, poll, result)
          : search<false>(nodes, map, start, isGoal, estimate, record_expanded, poll, result);
  finish(nodes, map, start, goal, result);
  return goal;
}

template <bool kUniform, class Nodes, class IsGoal, class Estimate>
std::uint32_t BucketSearch::search(Nodes& nodes, const costmap::CostGrid& map, grid::Cell start,
                                   const IsGoal& isGoal, const Estimate& estimate,
                                   bool record_expanded, base::StopPoll& poll,
                                   SearchResult& result) {
  constexpr KeyScale kScale = Nodes::kScale;
  const costmap::CostGrid::Weight* weights = map.weights().values().data();
  const CellOfIndex cellOf(map.geometry());
  const std::array<std::ptrdiff_t, 8> offsets = moves_.offsets();
  std::array<SearchKey, 8> lengths{};
  for (std::size_t step = 0; step < lengths.size(); ++step)
    lengths[step] = (step < 4 ? kScale.straight : diagonalKey(kScale, map.motion().diagonal_cost)) *
                    (kUniform ? map.minWeight() : 1);
  base::Statistics& counts = result.statistics;
  const std::uint32_t start_index = map.geometry().index(start).value();

  // 1. The start is the only open cell.
  nodes.beginQuery();
  nodes.setStart(start_index);
  const SearchKey first = estimate(start, start_index);
  open_.reset(first, bucketShift(map, kScale));
  open_.push(first, start_index);
  ++counts.generated;
  std::uint32_t goal = kNone;
  SearchKey goal_cost = kInfiniteKey;

  while (!open_.empty()) {
    const base::StopReason reason = poll.ask();
    if (reason != base::StopReason::NONE) {
      result.status = base::Stopped(reason).status();
      return kNone;
    }
    counts.peak_open = std::max(counts.peak_open, open_.size());
    if (goal != kNone && open_.lowest() >= goal_cost) break;

    // 2. A cell with nearly the least f-value, unless it was expanded since it was pushed, or its
    // f-value is no less than the cost found.
    const std::uint32_t from = open_.pop();
    if (nodes.closed(from)) continue;
    const SearchKey cost = nodes.cost(from);
    const grid::Cell cell = cellOf(from);
    if (goal != kNone && saturatingSum(cost, estimate(cell, from)) >= goal_cost) continue;
    nodes.close(from);
    ++counts.expanded;
    if (record_expanded) result.expanded.emplace_back(from);
    if (isGoal(from)) {
      goal = from;
      goal_cost = cost;
      continue;
    }

    // 3. Its moves.
    for (std::uint32_t moves = moves_.after(nodes.steps(from), from); moves != 0;
         moves &= moves - 1) {
      const auto step = static_cast<unsigned>(__builtin_ctz(moves));
      const auto to = static_cast<std::uint32_t>(from + offsets[step]);
      const SearchKey to_cost =
          cost + (kUniform ? lengths[step] : lengths[step] * std::max(weights[from], weights[to]));
      if (!nodes.isBetter(to, to_cost)) continue;  // one of equal cost leads nowhere else
      const grid::Cell to_cell{cell.column + kSteps[step].column, cell.row + kSteps[step].row};
      const SearchKey f = saturatingSum(to_cost, estimate(to_cell, to));

      // 4. A cheaper path: open the cell, or re-open it.
      if (f > kScale.largest) return kTooExpensive;
      if (nodes.improve(to, to_cost, step)) ++counts.reopened;
      open_.push(f, to);
      ++counts.generated;
    }
  }
  return goal;
}

}  // namespace grid_path_planner::planners
