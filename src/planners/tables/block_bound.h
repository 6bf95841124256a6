// A lower bound of the cost to go that knows what cells cost: from the least weights of blocks of
// cells, searched backwards from the goal on a lattice of the blocks' corners.
//
//   BlockBounds bounds(8);
//   bounds.prepare(map, stop);
//   const BlockEstimate bound(bounds.to(goal), kPackedScale, stop);
//   use(bound(cell));  // a key of that scale, never above the cost from the cell to the goal
//
// Where most cells weigh more than the minimum, as in the potential of a gentle inflation, the
// octile distance at the minimum weight says next to nothing, and A* expands nearly all that
// Dijkstra's algorithm does.
//
// The lattice's nodes are the corners of blocks of k x k cells. Each has a value; inside a
// block the bound is interpolated from the values of its four corners, linearly in each of the two
// triangles into which the diagonal through its least corner cuts it. Why it is a lower bound: let w
// be the least weight of the block's passable cells, S and D the lengths of a straight and of a
// diagonal step. The values keep, for every block that is not blocked:
//
// 1. corners of one side differ by at most k S w, opposite corners by at most k D w;
// 2. twice a corner is at most the sum of its two neighbours in the block, plus k D w.
//
// Let a be the least corner, d the opposite one, b between them. The gradient of the triangle a, b,
// d is (b - a, d - b) / k. By 1 a straight step inside the triangle changes the bound by at most
// S w, and a diagonal step along a-d by at most D w. A step along the other diagonal changes it by
// (2 b - a - d) / k: at most D w by 2, and no less than -D w, since d <= a + k D w by 1 and a
// <= b. So no step inside a block changes the bound by more than it costs. A step to another block
// lies one half in each (a diagonal one meets the corner), and each half costs at least that half of
// its block's share; the bound is continuous, since on a side it depends on the two corners of that
// side alone. The bound of the goal is 0, so along any path it is at most the cost of the path. The
// same holds for unit diagonals (D = S), and for four-connected maps with D = 2 S. The values are
// integers, rounded down at every step, which keeps 1 and 2 but for less than the cost of a step.
//
// The values are the largest for which 1 and 2 hold and the corners around the goal are 0. As no
// right side is below the values on it, Dijkstra's algorithm finds them; it goes only as far as it
// is asked, and goes on from there (Silver's resumable search, RRA*).
#pragma once

#include <cassert>
#include <cstdint>
#include <list>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "planners/core/bucket_queue.h"
#include "planners/core/keys.h"

namespace grid_path_planner::planners {

// The least weights of the blocks of a map; 0 where all is blocked, and around the map.
class BlockWeights {
 public:
  using Weight = costmap::CostGrid::Weight;

  // `side` of a block in cells: 4 or 8. Smaller: a larger bound for more time, with the
  // square of it.
  explicit BlockWeights(int side) : side_(side) {
    assert(side == 4 || side == 8);
    while (1 << shift_ < side) ++shift_;
  }

  // Throws Stopped.
  void prepare(const costmap::CostGrid& map, const base::StopToken& stop);
  // `changed`: a rectangle in the map outside which no weight changed. Whether a block's did.
  bool update(const costmap::CostGrid& map, const grid::CellRect& changed);

  // The lattice's node at the lower corner of the block that holds the cell. The nodes next to it are
  // 1 and stride() on.
  std::uint32_t nodeOf(grid::Cell cell) const {
    return (std::uint32_t(cell.row) >> shift_) * stride_ + (std::uint32_t(cell.column) >> shift_);
  }
  int side() const { return side_; }
  std::uint32_t stride() const { return stride_; }
  std::size_t nodes() const { return weights_.size(); }
  // Of the block below a node to its left; to its right: of node + 1; above: of node + stride().
  Weight below(std::uint32_t node) const { return weights_[node]; }
  Weight least() const { return least_; }
  const costmap::MotionModel& motion() const { return motion_; }

 private:
  bool set(const costmap::CostGrid& map, int column, int row);

  int side_;
  unsigned shift_ = 0;
  std::uint32_t stride_ = 0;
  Weight least_ = 1;
  costmap::MotionModel motion_;
  std::vector<Weight> weights_;  // with a frame of zeros
};

// The bound to one goal.
class BlockBound {
 public:
  // Units of a value: this many are the cost of a cell length at weight 1.
  static constexpr std::uint64_t kUnits = 64;
  static constexpr std::uint64_t kInfinite = ~std::uint64_t{0};

  explicit BlockBound(const BlockWeights& weights) : weights_(weights) {}

  // Begins anew. Precondition: the cell lies in the map.
  void reset(grid::Cell goal);
  grid::Cell goal() const { return goal_; }
  int side() const { return weights_.side(); }

  // The bound, in units of 1 / (2 side kUnits); kInfinite where no path leads to the goal. Throws
  // Stopped. Precondition: the cell is passable.
  std::uint64_t at(grid::Cell cell, const base::StopToken& stop) {
    const std::uint32_t node = weights_.nodeOf(cell);
    const Value* corner = &values_[node];
    const std::uint32_t stride = weights_.stride();
    Value a = corner[0], b = corner[1], c = corner[stride], d = corner[stride + 1];
    const Value ab = a > b ? a : b, cd = c > d ? c : d;
    if (__builtin_expect((ab > cd ? ab : cd) >= settled_below_, 0)) {
      if (!settle(node, stop)) return kInfinite;
      a = corner[0], b = corner[1], c = corner[stride], d = corner[stride + 1];
    }
    const int side = weights_.side();
    return interpolated(a, b, c, d, cell.column & (side - 1), cell.row & (side - 1), side);
  }

  // The same without searching on: where the search did not come, the least that cells there may have.
  std::uint64_t known(grid::Cell cell) const {
    const std::uint32_t node = weights_.nodeOf(cell), stride = weights_.stride();
    const Value* corner = &values_[node];
    const Value a = corner[0], b = corner[1], c = corner[stride], d = corner[stride + 1];
    const int side = weights_.side();
    const Value ab = a > b ? a : b, cd = c > d ? c : d;
    if ((ab > cd ? ab : cd) < settled_below_)
      return interpolated(a, b, c, d, cell.column & (side - 1), cell.row & (side - 1), side);
    const Value below = a < b ? a : b, above = c < d ? c : d;
    const Value least = below < above ? below : above;
    return 2 * std::uint64_t(side) * (least < settled_below_ ? least : settled_below_);
  }

  std::uint64_t expanded() const { return expanded_; }

 private:
  using Value = std::uint32_t;
  static constexpr Value kUnreached = ~Value{0};
  // Values end here: what is as far keeps this, which is below its value.
  static constexpr Value kMost = Value{1} << 31;

  // Between a, b (to its right), c (above a) and d.
  static std::uint64_t interpolated(Value a, Value b, Value c, Value d, int column, int row,
                                    int side) {
    std::int64_t x = 2 * std::int64_t(column) + 1;
    const std::int64_t y = 2 * std::int64_t(row) + 1;
    const bool mirrored = (b < c ? b : c) < (a < d ? a : d);
    const std::int64_t first = mirrored ? b : a, last = mirrored ? c : d;
    const std::int64_t beside = mirrored ? a : b, above = mirrored ? d : c;
    x = mirrored ? 2 * side - x : x;
    const std::int64_t more = x > y ? x - y : y - x, less = x > y ? y : x;
    return std::uint64_t(2 * side * first + less * (last - first) +
                         more * ((x > y ? beside : above) - first));
  }

  [[gnu::noinline]] bool settle(std::uint32_t node, const base::StopToken& stop);
  void expand(std::uint32_t node);
  void lower(std::uint32_t node, Value value);
  void lowerSide(std::uint32_t to, Value value, Value weight, Value other);
  void lowerAcross(std::uint32_t beside, std::uint32_t above, std::uint32_t opposite, Value value,
                   Value weight);

  const BlockWeights& weights_;
  grid::Cell goal_{-1, -1};
  std::vector<Value> values_;
  std::vector<std::uint8_t> is_open_;  // whether a node was lowered since it was expanded
  Value settled_below_ = 0;
  Value straight_ = 0, diagonal_ = 0;  // of a block of weight 1
  std::uint64_t expanded_ = 0;
  BucketQueue open_;
};

// The bounds of a map to the goals that were asked for last.
class BlockBounds {
 public:
  // `side` of a block in cells: 4 or 8.
  explicit BlockBounds(int side) : weights_(side) {}
  int side() const { return weights_.side(); }
  // The next prepare() makes blocks of this side.
  void setSide(int side);

  // With all bounds.
  static std::size_t bytesFor(const grid::GridGeometry& geometry, int side);

  // Throws Stopped.
  void prepare(const costmap::CostGrid& map, const base::StopToken& stop);
  // `changed`: the cells whose weights changed since.
  void update(const costmap::CostGrid& map, const std::vector<grid::CellRect>& changed);
  void release();

  // Precondition: the cell lies in the prepared map. Valid until the next call of anything.
  BlockBound& to(grid::Cell goal);

 private:
  static constexpr std::size_t kKept = 3;

  BlockWeights weights_;
  std::list<BlockBound> bounds_;  // the last used first
};

// A bound as keys.
class BlockEstimate {
 public:
  BlockEstimate(BlockBound& bound, const KeyScale& scale, const base::StopToken& stop)
      : bound_(bound), stop_(stop), straight_(scale.straight) {
    while (1U << shift_ < 2 * unsigned(bound.side()) * BlockBound::kUnits) ++shift_;
  }

  // kInfiniteKey where no path leads to the goal. Throws Stopped.
  SearchKey operator()(grid::Cell cell) const {
    const std::uint64_t value = bound_.at(cell, stop_);
    if (value == BlockBound::kInfinite) return kInfiniteKey;
    return keyOf(value);
  }
  // See BlockBound::known().
  SearchKey known(grid::Cell cell) const { return keyOf(bound_.known(cell)); }

 private:
  __extension__ using Product = unsigned __int128;

  SearchKey keyOf(std::uint64_t value) const {
    return SearchKey(Product{value} * straight_ >> shift_);
  }

  BlockBound& bound_;
  const base::StopToken& stop_;
  SearchKey straight_;
  unsigned shift_ = 0;  // of the units of a bound
};

}  // namespace grid_path_planner::planners
