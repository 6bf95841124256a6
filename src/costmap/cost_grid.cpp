#include "grid_path_planner/costmap/cost_grid.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstring>
#include <limits>
#include <mutex>
#include <tuple>
#include <utility>

#include "costmap/weight_counts.h"

namespace grid_path_planner::costmap {

using base::StopPoll, base::StopToken;
using grid::addChange, grid::Cell, grid::CellRect, grid::copyCells, grid::Grid, grid::GridGeometry,
    grid::Occupancy;

namespace {

// The least weight but blocked, and the largest.
std::pair<CostGrid::Weight, CostGrid::Weight> rangeOf(
    const std::vector<CostGrid::Weight>& weights) {
  constexpr std::size_t kTogether = 8;
  using Eight = CostGrid::Weight __attribute__((vector_size(kTogether * sizeof(weights[0]))));
  // Blocked is 0: one below it wraps to the largest value and never wins.
  Eight least_eight = Eight{} - 1, most_eight = {};
  std::size_t i = 0;
  for (; i + kTogether <= weights.size(); i += kTogether) {
    Eight eight;
    std::memcpy(&eight, weights.data() + i, sizeof eight);
    most_eight = eight > most_eight ? eight : most_eight;
    eight -= 1;
    least_eight = eight < least_eight ? eight : least_eight;
  }
  CostGrid::Weight least = std::numeric_limits<CostGrid::Weight>::max(), most = CostGrid::kBlocked;
  const auto add = [&](CostGrid::Weight lower, CostGrid::Weight upper) {
    least = std::min(least, lower);
    most = std::max(most, upper);
  };
  for (std::size_t lane = 0; lane < kTogether; ++lane) add(least_eight[lane], most_eight[lane]);
  for (; i < weights.size(); ++i) add(static_cast<CostGrid::Weight>(weights[i] - 1), weights[i]);
  return {static_cast<CostGrid::Weight>(least + 1), most};
}

// Row by row.
template <class T>
Grid<T> copied(const Grid<T>& from, const StopToken& stop) {
  StopPoll poll(stop, 64);
  std::vector<T> values;
  values.reserve(from.values().size());
  for (int row = 0; row < from.height(); ++row) {
    poll();
    values.insert(values.end(), from.row(row), from.row(row) + from.width());
  }
  return Grid<T>(from.geometry(), std::move(values));
}

WeightCounts countsOf(const Grid<CostGrid::Weight>& weights, const StopToken& stop) {
  StopPoll poll(stop, 64);
  WeightCounts counts;
  for (int row = 0; row < weights.height(); ++row) {
    poll();
    counts.add(weights.row(row), weights.row(row) + weights.width());
  }
  return counts;
}

}  // namespace

// What is computed from the weights when it is needed first.
struct CostGrid::Derived {
  std::mutex computing_bits;
  BitMaps bits;
  std::atomic<bool> has_bits{false};
  WeightCounts counts;  // empty before the first edit

  std::shared_ptr<Derived> copy() {
    auto other = std::make_shared<Derived>();
    const std::lock_guard<std::mutex> lock(computing_bits);
    if (has_bits) other->bits = bits;
    other->has_bits = has_bits.load();
    other->counts = counts;
    return other;
  }

  void updateBits(const Grid<Weight>& weights, const std::vector<CellRect>& rects) {
    if (!has_bits) return;
    for (const CellRect& rect : rects) bits.update(weights, rect, StopToken());
  }
};

CostGrid::CostGrid() : derived_(std::make_shared<Derived>()) {}

CostGrid::CostGrid(Grid<Weight> weights, Grid<Occupancy> classes, const MotionModel& motion)
    : CostGrid(std::move(weights), std::move(classes), motion, 1, GridGeometry()) {
  original_ = geometry();
}

CostGrid::CostGrid(Grid<Weight> weights, Grid<Occupancy> classes, const MotionModel& motion,
                   int kernel, const GridGeometry& original)
    : weights_(std::move(weights)),
      classes_(std::move(classes)),
      motion_(motion),
      kernel_(kernel),
      original_(original),
      derived_(std::make_shared<Derived>()) {
  assert(weights_.geometry() == classes_.geometry());
  std::tie(min_weight_, max_weight_) = rangeOf(weights_.values());
}

Eigen::Vector2d CostGrid::waypoint(Cell cell) const {
  const auto middle = [this](int block, int side) {
    const int first = block * kernel_;
    return 0.5 * (first + std::min(first + kernel_, side));
  };
  return original_.worldFromGrid(
      {middle(cell.column, original_.width()), middle(cell.row, original_.height())});
}

const BitMaps& CostGrid::bitMaps(const StopToken& stop) const {
  Derived& derived = *derived_;
  if (derived.has_bits) return derived.bits;
  const std::lock_guard<std::mutex> lock(derived.computing_bits);
  if (!derived.has_bits) derived.bits = BitMaps(weights_, stop);
  derived.has_bits = true;
  return derived.bits;
}

std::size_t CostGrid::bytes() const {
  const std::size_t bits = derived_->has_bits ? derived_->bits.bytes() : 0;
  return geometry().size() * (sizeof(Weight) + sizeof(Occupancy)) + derived_->counts.bytes() + bits;
}

void CostGrid::finishEdit(const CostGrid& before, const std::vector<CellRect>& rects) {
  ownDerived();
  WeightCounts& counts = derived_->counts;
  if (counts.empty())
    counts.add(weights_);
  else
    for (const CellRect& rect : rects) counts.replace(before.weights_, weights_, rect);
  min_weight_ = counts.minWeight();
  max_weight_ = counts.maxWeight();
  derived_->updateBits(weights_, rects);
}

std::unique_ptr<CostGrid> CostGrid::copyToEdit(const StopToken& stop) const {
  auto copy = std::make_unique<CostGrid>(copied(weights_, stop), copied(classes_, stop), motion_,
                                         kernel_, original_);
  copy->kept_ = kept_;
  copy->revision_ = revision_;
  copy->derived_ = derived_->copy();
  if (copy->derived_->counts.empty()) copy->derived_->counts = countsOf(weights_, stop);
  return copy;
}

void CostGrid::catchUp(const CostGrid& with, const Change& change) {
  if (change.weights.empty() && change.classes.empty()) return;
  copyCells(with.weights_, change.weights, weights_);
  copyCells(with.classes_, change.classes, classes_);
  min_weight_ = with.min_weight_;
  max_weight_ = with.max_weight_;
  ownDerived();
  derived_->counts = with.derived_->counts;
  derived_->updateBits(weights_, change.weights);
}

void CostGrid::ownDerived() {
  if (derived_.use_count() > 1) derived_ = derived_->copy();
}

void copyCells(const CostGrid& from, const CostGrid::Change& change, CostGrid& to) {
  to.catchUp(from, change);
}

void addChange(const CostGrid::Change& later, CostGrid::Change& to) {
  addChange(later.weights, to.weights);
  addChange(later.classes, to.classes);
}

bool stepAllowed(const CostGrid& map, Cell from, Cell to) {
  const int columns = std::abs(to.column - from.column);
  const int rows = std::abs(to.row - from.row);
  if (std::max(columns, rows) != 1) return false;
  if (!map.passable(from) || !map.passable(to)) return false;
  if (columns + rows == 1) return true;
  if (map.motion().connectivity == Connectivity::FOUR) return false;
  if (map.motion().cut_corners) return true;
  return map.passable({from.column, to.row}) && map.passable({to.column, from.row});
}

ExactCost stepCost(const CostGrid& map, Cell from, Cell to) {
  assert(stepAllowed(map, from, to));
  const std::int64_t weight =
      std::int64_t{std::max(map.weight(from), map.weight(to))} * map.kernel();
  const bool root = from.column != to.column && from.row != to.row &&
                    map.motion().diagonal_cost == DiagonalCost::SQRT2;
  return root ? ExactCost{0, weight} : ExactCost{weight, 0};
}

ExactCost costOfSteps(const CostGrid& map, const std::vector<Cell>& cells) {
  ExactCost cost;
  for (std::size_t i = 1; i < cells.size(); ++i) cost += stepCost(map, cells[i - 1], cells[i]);
  return cost;
}

}  // namespace grid_path_planner::costmap
