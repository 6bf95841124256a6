// The jump point search of planner weighted_jump_point: A* over cells of any weight that follows one
// of many paths of equal cost and jumps over cells without a choice. For diagonals of sqrt 2 that
// cut no corners.
//
//   WeightedJumpSearch search;
//   search.prepare(map, stop);
//   SearchResult result = search.run(map, request, stop);
//
// Guaranteed: the cost is the least there is, whatever the weights.
//
// A search begins with the octile distance at the least weight. Once it has expanded so many cells
// that another bound pays, it goes on with that of planners/tables/block_bound.h; cells that are
// open are put back when their turn comes. Where it is given landmarks (planners/tables/landmark_table.h)
// these bound it from the beginning, and nothing else does but the octile distance.
//
// Only natural steps outside dead branches are taken (planners/core/natural_moves.h,
// planners/jump_point/weighted_jump_map.h). A straight jump pushes the cell where it ends. A
// diagonal jump makes the straight jumps of its two straight parts at every cell where they are no
// dead ends, and goes on, without the open list, until its f-value exceeds that of its first cell
// by kDiagonalSlack. A jump ends at a cell that has a lower g-value. A cell is pushed again when its
// g-value falls, or when it is reached at the same cost by another step after which further steps
// are natural; so the order within a bucket of the open list does not matter.
//
// Ideas: word scans and straight jump points of diagonal jumps, Harabor & Grastien 2011, 2014;
// weights, Carlson, Harabor, Stuckey et al. 2023. The canonical order, the dead branches, dead
// ends, stops inside gradients and their pricing are this package's.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/zeroed_array.h"
#include "grid_path_planner/planners/planner.h"
#include "planners/astar/bound_choice.h"
#include "planners/core/bucket_queue.h"
#include "planners/core/keys.h"
#include "planners/core/stamped_array.h"
#include "planners/jump_point/weighted_jump_map.h"
#include "planners/tables/block_bound.h"
#include "planners/tables/landmark_table.h"

namespace grid_path_planner::planners {

class WeightedJumpSearch {
 public:
  // Sides of the bound's blocks.
  static constexpr int kSmallBlock = 4;
  static constexpr int kBlock = 8;

  static std::size_t bytesFor(const grid::GridGeometry& geometry) {
    return WeightedJumpMap::bytesFor(geometry) + BlockBounds::bytesFor(geometry, kSmallBlock) +
           geometry.size() * sizeof(StampedG);
  }

  // `block`: the side of the bound's blocks in cells. Throws Stopped.
  void prepare(const costmap::CostGrid& map, const base::StopToken& stop, int block = kBlock);
  // `changed`: the cells whose weights changed since. `block` may be another than before. Throws
  // Stopped.
  void update(const costmap::CostGrid& map, const std::vector<grid::CellRect>& changed,
              const base::StopToken& stop, int block = kBlock);
  // Makes all tiles ready, so that no run() makes one, and has the memory of g-values mapped; what
  // is done stays where it is stopped. Throws Stopped.
  void finish(const costmap::CostGrid& map, const base::StopToken& stop);
  bool finished() const { return jumps_.allReady(); }
  std::size_t tilesReady() const { return jumps_.tilesReady(); }
  // After how many expansions of a query the bound of the blocks is made (tables/block_bound.h).
  void makeBoundAfter(std::size_t expansions) { bound_after_ = expansions; }
  // What the last run() tells of the bound of the blocks: of one without it that found a path of at least
  // kLeastWeighed expansions. The next run() or update() forgets it. Throws Stopped.
  std::optional<BoundChoice::Evidence> evidence(const base::StopToken& stop);
  // Frees all memory; prepare() must be called before the next run().
  void release();

  // FOUND, UNREACHABLE, TIMEOUT or CANCELLED. Throws TooManyTiles where it has to make more than
  // `most_tiles` tiles, which stay, and Stopped while it makes one. Throws TooExpensive where there is no path that costs
  // less than the keys hold, 17.6e6 cell lengths x weight, but there may be a more expensive one.
  // Precondition: `map` is the prepared one, start and goal are passable, `landmarks` bound the cost to
  // the goal in kMediumScale.
  SearchResult run(const costmap::CostGrid& map, const SearchRequest& request,
                   const base::StopToken& stop,
                   std::uint64_t most_tiles = std::numeric_limits<std::uint64_t>::max(),
                   std::optional<LandmarkBound> landmarks = std::nullopt);

 private:
  using Key = SearchKey;
  static constexpr Key kStraight = kMediumScale.straight;
  static constexpr Key kDiagonal = kMediumScale.diagonal;
  static constexpr Key kLargest = kMediumScale.largest;
  static constexpr int kKeyBits = 48;
  static_assert(kLargest == (Key{1} << kKeyBits) - 1);
  static constexpr std::size_t kLeastWeighed = 512;
  static constexpr std::size_t kMostSamples = 4096;
  static constexpr std::uint64_t kFirstSampledEach = 8;

  // A g-value of one query: the query's number, then kLargest - g. The larger one is the better
  // one, and any of this query is better than any of an earlier query.
  using StampedG = std::uint64_t;

  void startQuery(const costmap::CostGrid& map, const SearchRequest& request);
  SearchResult search(const SearchRequest& request, const base::StopToken& stop);
  void expandStart(grid::Cell start);
  void expand(std::uint32_t index, grid::Cell cell, Key g);
  void jumpBy(unsigned steps, std::uint32_t index, grid::Cell cell, Key g);
  template <unsigned kStep>
  void jumpStraight(grid::Cell cell, Key g);
  template <unsigned kStep>
  void jumpDiagonally(std::uint32_t index, grid::Cell cell, Key g, Key limit);
  bool beyondMost(Key f);
  void relax(std::uint32_t index, Key g);
  void reach(std::uint32_t index, NaturalMoves steps, unsigned step, Key f);

  std::uint32_t indexOf(grid::Cell cell) const {
    return std::uint32_t(cell.row) * width_ + std::uint32_t(cell.column);
  }
  Key gOf(std::uint32_t index) const { return kLargest - (g_[index] & kLargest); }
  bool hasLessThan(std::uint32_t index, Key g) const { return zero_g_ - g < g_[index]; }
  bool hasG(std::uint32_t index) const { return stamp_.wrote(g_[index]); }
  Key estimate(grid::Cell cell) const {
    if (bound_) return (*bound_)(cell);
    return landmarks_ ? byLandmarks(cell) : octile(cell);
  }
  Key byLandmarks(grid::Cell cell) const;
  Key octile(grid::Cell cell) const;
  bool needsBound() const { return counts_.expanded >= bound_after_ && !bound_ && !landmarks_; }
  bool makeBound(const SearchRequest& request, const base::StopToken& stop);
  void sample(std::uint32_t index) {
    if (counts_.expanded % sampled_each_ == 0) sample_.push_back(index);
    if (sample_.size() >= kMostSamples) thinSample();
  }
  void thinSample();
  void trace(grid::Cell start, SearchResult& result) const;
  grid::Cell predecessorOf(grid::Cell cell, unsigned step) const;
  SearchResult withStatus(base::Status status, SearchResult result) const;

  WeightedJumpMap jumps_;
  BlockBounds blocks_{kSmallBlock};
  std::size_t bound_after_ = 0;
  bool g_is_mapped_ = false;
  base::ZeroedArray<StampedG> g_;
  QueryStamp<StampedG, kKeyBits> stamp_;
  BucketQueue open_;

  // Of the current query, then of the last one
  grid::Cell start_;
  std::vector<std::uint32_t> sample_;  // of the cells that it expanded,
  std::uint64_t sampled_each_ = kFirstSampledEach;
  const costmap::CostGrid* map_ = nullptr;
  const costmap::CostGrid::Weight* weights_ = nullptr;
  std::uint32_t width_ = 0;
  grid::Cell goal_;
  std::uint32_t goal_index_ = 0;
  Key straight_ = 0;     // of the heuristic: a straight cell length at the least weight,
  Key saving_ = 0;       // and what a diagonal step saves against two of these
  StampedG zero_g_ = 0;  // g-value 0
  std::optional<BlockEstimate> bound_;  // once it is made
  std::optional<LandmarkBound> landmarks_;
  Key slack_ = 0;  // of a diagonal jump
  unsigned bucket_shift_ = 0;
  Key most_ = 0;  // paths that cost as much are of no use: the goal's g-value, once it has one
  bool goal_reached_ = false;
  bool found_ = false;  // with nothing left that could be less
  bool too_expensive_ =
      false;  // a path was left out, perhaps because the keys do not hold its cost
  base::Statistics counts_;
};

}  // namespace grid_path_planner::planners
