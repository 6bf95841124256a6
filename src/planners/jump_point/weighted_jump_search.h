// A* that follows one of the many equally cheap paths and runs over the cells where nothing can be
// decided: the search of planner weighted_jump_point, for diagonals of sqrt 2 that cut no corners.
//
//   WeightedJumpSearch search;
//   search.prepare(map, stop);
//   SearchResult result = search.run(map, request, stop);
//
// Guaranteed: the cost is the least there is, whatever the weights.
//
// Only natural steps outside dead branches are taken (planners/core/natural_moves.h,
// planners/jump_point/weighted_jump_map.h). A straight run queues the cell where it ends. A diagonal run looks
// along its two straight parts at every cell from which they find something, and goes on, without
// the open list, until its turn comes later than that of others by kAhead. A run ends at a cell
// that was reached cheaper. A cell that gets cheaper, or is reached at the same cost from another
// side after which further steps are natural, is queued again, so the order within a bucket of the
// open list does not matter.
//
// Ideas: word scans and straight jump points of diagonal runs, Harabor & Grastien 2011, 2014;
// weights, Carlson, Harabor, Stuckey et al. 2023. The canonical order, the dead branches, blind
// cells, stops inside gradients and their pricing are this package's.
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/zeroed_array.h"
#include "grid_path_planner/planners/bucket_queue.h"
#include "grid_path_planner/planners/keys.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/jump_point/weighted_jump_map.h"

namespace grid_path_planner::planners {

class WeightedJumpSearch {
 public:
  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return WeightedJumpMap::bytesFor(geometry) + geometry.size() * sizeof(Label);
  }

  // Throw Stopped. `changed`: the cells whose weights changed since.
  void prepare(const costmap::CostGrid& map, const base::StopToken& stop);
  void update(const costmap::CostGrid& map, const grid::CellRect& changed,
              const base::StopToken& stop);
  // Nothing is prepared any more, no memory is held.
  void release();

  // FOUND, UNREACHABLE, TIMEOUT or CANCELLED. Throws TooExpensive where no path costs less than its
  // keys hold, 17.6e6 cell lengths x weight, but a more expensive one may exist.
  // Precondition: `map` is the prepared one, start and goal are passable.
  SearchResult run(const costmap::CostGrid& map, const SearchRequest& request,
                   const base::StopToken& stop);

 private:
  using Key = SearchKey;
  static constexpr Key kStraight = kMediumScale.straight;
  static constexpr Key kDiagonal = kMediumScale.diagonal;
  static constexpr Key kLargest = kMediumScale.largest;
  static constexpr int kKeyBits = 48;
  static_assert(kLargest == (Key{1} << kKeyBits) - 1);

  // Number of the query, then kLargest - g: a larger label is a better one, and any label of this
  // query is better than any of an earlier one.
  using Label = std::uint64_t;

  void beginQuery(const costmap::CostGrid& map, const SearchRequest& request);
  SearchResult search(const SearchRequest& request, const base::StopToken& stop);
  void expandStart(grid::Cell start);
  void expand(std::uint32_t index, grid::Cell cell, Key g);
  void take(unsigned steps, std::uint32_t index, grid::Cell cell, Key g);
  template <unsigned kStep>
  void runStraight(grid::Cell cell, Key g);
  template <unsigned kStep>
  void runDiagonally(std::uint32_t index, grid::Cell cell, Key g);
  bool hopeless(Key f);
  bool improve(std::uint32_t index, Key g);
  void reach(std::uint32_t index, NaturalMoves steps, unsigned step, Key f);

  std::uint32_t indexOf(grid::Cell cell) const {
    return std::uint32_t(cell.row) * width_ + std::uint32_t(cell.column);
  }
  Key costOf(std::uint32_t index) const { return kLargest - (labels_[index] & kLargest); }
  bool labelled(std::uint32_t index) const { return labels_[index] >> kKeyBits == query_; }
  Key estimate(grid::Cell cell) const;
  void trace(grid::Cell start, SearchResult& result) const;
  grid::Cell labelledBefore(grid::Cell cell, unsigned step) const;
  SearchResult withStatus(base::Status status, SearchResult result) const;

  WeightedJumpMap jumps_;
  base::ZeroedArray<Label> labels_;
  std::uint64_t query_ = 0;
  BucketQueue open_;

  // Of the present query
  const costmap::CostGrid* map_ = nullptr;
  const costmap::CostGrid::Weight* weights_ = nullptr;
  std::uint32_t width_ = 0;
  grid::Cell goal_;
  std::uint32_t goal_index_ = 0;
  Key straight_ = 0;  // of the estimate: a straight cell length at the cheapest weight,
  Key saving_ = 0;    // and what a diagonal step saves against two of these
  Label fresh_ = 0;   // label of cost 0
  Key bound_ = 0;     // what costs as much is of no use: the goal's cost, once it is known
  bool goal_reached_ = false;
  bool too_expensive_ = false;  // something was left out that the keys do not hold
  base::Statistics counts_;
};

}  // namespace grid_path_planner::planners
