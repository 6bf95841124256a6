#include "planners/tables/block_bound.h"

#include <algorithm>
#include <cstring>

#include "planners/core/simd_neighbourhood.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::Connectivity, costmap::CostGrid, costmap::DiagonalCost, costmap::MotionModel;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

std::size_t blocksAlong(int cells, int side) {
  return (std::size_t(cells) + std::size_t(side) - 1) / std::size_t(side);
}

// Nodes are one more than blocks in a row, and above the last row follows one of blocked blocks.
std::size_t nodesFor(const GridGeometry& geometry, int side) {
  return (blocksAlong(geometry.width(), side) + 2) * (blocksAlong(geometry.height(), side) + 2);
}

// sqrt 2 of a block's side in units, rounded down; D <= 2 S bounds nothing more than S does.
std::uint32_t diagonalOf(const MotionModel& motion, std::uint64_t straight) {
  if (motion.connectivity == Connectivity::FOUR) return std::uint32_t(2 * straight);
  if (motion.diagonal_cost == DiagonalCost::UNIT) return std::uint32_t(straight);
  return std::uint32_t(straight * (kPackedScale.diagonal - 1) / kPackedScale.straight);
}

}  // namespace

void BlockWeights::prepare(const CostGrid& map, const StopToken& stop) {
  const GridGeometry& geometry = map.geometry();
  stride_ = std::uint32_t(blocksAlong(geometry.width(), side_) + 2);
  motion_ = map.motion();
  least_ = std::max<Weight>(map.minWeight(), 1);
  weights_.assign(nodesFor(geometry, side_), 0);
  StopPoll poll(stop, 64);
  for (int row = 0; row < geometry.height(); row += side_) {
    poll();
    for (int column = 0; column < geometry.width(); column += kSimdCells) set(map, column, row);
  }
}

bool BlockWeights::update(const CostGrid& map, const CellRect& changed) {
  bool any = false;
  for (int row = changed.row / side_ * side_; row < changed.row + changed.height; row += side_)
    for (int column = changed.column / kSimdCells * kSimdCells;
         column < changed.column + changed.width; column += kSimdCells)
      any = set(map, column, row) || any;
  least_ = std::max<Weight>(map.minWeight(), 1);
  return any;
}

// The blocks of eight columns from this cell on, one or two. Whether a weight is another than it was.
bool BlockWeights::set(const CostGrid& map, int column, int row) {
  using Eight = SimdNeighbourhood::Eight;
  const int width = std::min(kSimdCells, map.geometry().width() - column);
  const int end = std::min(row + side_, map.geometry().height());
  // One less, so that 0, which is blocked, is the largest.
  Eight least = ~Eight{};
  for (int at = row; at < end; ++at) {
    Eight weights{};
    const Weight* from = map.weights().row(at) + column;
    if (width == kSimdCells)
      std::memcpy(&weights, from, sizeof weights);
    else
      std::memcpy(&weights, from, std::size_t(width) * sizeof *from);
    weights -= 1;
    least = weights < least ? weights : least;
  }
  bool any = false;
  Weight* block = &weights_[nodeOf({column, row}) + stride_ + 1];
  for (int first = 0; first < width; first += side_, ++block) {
    Weight one = least[first];
    for (int i = 1; i < side_; ++i) one = std::min<Weight>(one, least[first + i]);
    any |= *block != Weight(one + 1);
    *block = Weight(one + 1);
  }
  return any;
}

void BlockBound::reset(Cell goal) {
  goal_ = goal;
  values_.assign(weights_.nodes(), kUnreached);
  is_open_.assign(weights_.nodes(), 0);
  settled_below_ = 0;
  expanded_ = 0;
  straight_ = Value(kUnits * std::uint64_t(weights_.side()));
  diagonal_ = diagonalOf(weights_.motion(), straight_);
  open_.reset(0, 63U - unsigned(__builtin_clzll(std::uint64_t{straight_} * weights_.least())));
  const std::uint32_t node = weights_.nodeOf(goal), stride = weights_.stride();
  for (const std::uint32_t corner : {node, node + 1, node + stride, node + stride + 1})
    lower(corner, 0);
}

inline void BlockBound::lower(std::uint32_t node, Value value) {
  Value& known = values_[node];
  value = std::min(value, kMost);
  if (value >= known) return;
  known = value;
  is_open_[node] = 1;
  open_.push(value, node);
}

// Around a node whose value is final but for those of its bucket; a node that falls again comes
// again.
void BlockBound::expand(std::uint32_t node) {
  const std::uint32_t stride = weights_.stride();
  const std::uint32_t up = node + stride, down = node - stride;
  const Value value = values_[node];
  const Value north_east = weights_.below(up + 1), north_west = weights_.below(up);
  const Value south_east = weights_.below(node + 1), south_west = weights_.below(node);
  lowerSide(node + 1, value, north_east, south_east);
  lowerSide(node - 1, value, north_west, south_west);
  lowerSide(up, value, north_east, north_west);
  lowerSide(down, value, south_east, south_west);
  lowerAcross(node + 1, up, up + 1, value, north_east);
  lowerAcross(node - 1, up, up - 1, value, north_west);
  lowerAcross(node + 1, down, down + 1, value, south_east);
  lowerAcross(node - 1, down, down - 1, value, south_west);
}

// Over the side of two blocks.
inline void BlockBound::lowerSide(std::uint32_t to, Value value, Value weight, Value other) {
  // One less, so that 0, which is blocked, is the largest.
  const Value least = std::min(weight - 1, other - 1) + 1;
  if (least != CostGrid::kBlocked) lower(to, value + least * straight_);
}

// Through a block.
inline void BlockBound::lowerAcross(std::uint32_t beside, std::uint32_t above,
                                    std::uint32_t opposite, Value value, Value weight) {
  if (weight == CostGrid::kBlocked) return;
  const Value across = weight * diagonal_;
  const Value other = values_[opposite];
  if (other > value) return lower(opposite, value + across);
  const auto side = Value((std::uint64_t{value} + other + across) / 2);
  lower(beside, side);
  lower(above, side);
}

bool BlockBound::settle(std::uint32_t node, const StopToken& stop) {
  const std::uint32_t stride = weights_.stride();
  StopPoll poll(stop, 256);
  while (!open_.empty()) {
    settled_below_ = Value(open_.lowest());
    const Value* corner = &values_[node];
    if (std::max({corner[0], corner[1], corner[stride], corner[stride + 1]}) < settled_below_)
      return true;
    poll();
    const std::uint32_t next = open_.pop();
    if (is_open_[next] == 0) continue;  // a duplicate
    is_open_[next] = 0;
    ++expanded_;
    expand(next);
  }
  settled_below_ = kUnreached;
  const Value* corner = &values_[node];
  return std::max({corner[0], corner[1], corner[stride], corner[stride + 1]}) < kUnreached;
}

std::size_t BlockBounds::bytesFor(const GridGeometry& geometry, int side) {
  return nodesFor(geometry, side) *
         (sizeof(BlockWeights::Weight) + kKept * (sizeof(std::uint32_t) + sizeof(std::uint8_t)));
}

void BlockBounds::prepare(const CostGrid& map, const StopToken& stop) {
  bounds_.clear();
  weights_.prepare(map, stop);
}

void BlockBounds::update(const CostGrid& map, const std::vector<CellRect>& changed) {
  bool any = false;
  for (const CellRect& rect : changed) any = weights_.update(map, rect) || any;
  if (any) bounds_.clear();
}

void BlockBounds::setSide(int side) {
  bounds_.clear();
  weights_ = BlockWeights(side);
}

void BlockBounds::release() {
  setSide(weights_.side());
}

BlockBound& BlockBounds::to(Cell goal) {
  const auto known = std::find_if(bounds_.begin(), bounds_.end(),
                                  [goal](const BlockBound& each) { return each.goal() == goal; });
  if (known != bounds_.end()) {
    bounds_.splice(bounds_.begin(), bounds_, known);
    return bounds_.front();
  }
  if (bounds_.size() < kKept)
    bounds_.emplace_front(weights_);
  else
    bounds_.splice(bounds_.begin(), bounds_, std::prev(bounds_.end()));
  bounds_.front().reset(goal);
  return bounds_.front();
}

}  // namespace grid_path_planner::planners
