#include "grid_path_planner/costmap/cost_grid.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <limits>
#include <mutex>
#include <utility>

namespace grid_path_planner::costmap {

using base::StopToken;
using grid::Cell;
using grid::CellRect;
using grid::copyCells;
using grid::Grid;
using grid::GridGeometry;
using grid::Occupancy;

namespace {

CostGrid::Weight cheapestOf(const std::vector<CostGrid::Weight>& weights) {
  // Blocked is 0: one below it wraps to the largest value and never wins.
  CostGrid::Weight least = std::numeric_limits<CostGrid::Weight>::max();
  for (const CostGrid::Weight weight : weights)
    least = std::min(least, static_cast<CostGrid::Weight>(weight - 1));
  return static_cast<CostGrid::Weight>(least + 1);
}

CostGrid::Weight dearestOf(const std::vector<CostGrid::Weight>& weights) {
  CostGrid::Weight most = CostGrid::kBlocked;
  for (const CostGrid::Weight weight : weights) most = std::max(most, weight);
  return most;
}

}  // namespace

struct CostGrid::LazyBitMaps {
  std::mutex making;
  BitMaps maps;
  std::atomic<bool> made{false};

  std::shared_ptr<LazyBitMaps> copy() {
    auto other = std::make_shared<LazyBitMaps>();
    const std::lock_guard<std::mutex> lock(making);
    if (made) other->maps = maps;
    other->made = made.load();
    return other;
  }
};

CostGrid::CostGrid() : bit_maps_(std::make_shared<LazyBitMaps>()) {}

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
      cheapest_(cheapestOf(weights_.values())),
      dearest_(dearestOf(weights_.values())),
      bit_maps_(std::make_shared<LazyBitMaps>()) {
  assert(weights_.geometry() == classes_.geometry());
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
  LazyBitMaps& lazy = *bit_maps_;
  if (lazy.made) return lazy.maps;
  const std::lock_guard<std::mutex> lock(lazy.making);
  if (!lazy.made) lazy.maps = BitMaps(weights_, stop);
  lazy.made = true;
  return lazy.maps;
}

std::size_t CostGrid::bytes() const {
  const std::size_t bits = bit_maps_->made ? bit_maps_->maps.bytes() : 0;
  return geometry().size() * (sizeof(Weight) + sizeof(Occupancy)) + counts_.bytes() + bits;
}

void CostGrid::finishEdit(const CostGrid& before, const CellRect& rect) {
  assert(geometry().rect().intersection(rect) == rect);
  if (counts_.empty())
    counts_.add(weights_);
  else
    counts_.replace(before.weights_, weights_, rect);
  cheapest_ = counts_.cheapest();
  dearest_ = counts_.dearest();
  updateBitMaps(rect);
}

void CostGrid::catchUp(const CostGrid& with, const Change& change) {
  copyCells(with.weights_, change.weights, weights_);
  copyCells(with.classes_, change.classes, classes_);
  counts_ = with.counts_;
  cheapest_ = with.cheapest_;
  dearest_ = with.dearest_;
  updateBitMaps(change.weights);
}

void CostGrid::updateBitMaps(const CellRect& rect) {
  if (bit_maps_.use_count() > 1) bit_maps_ = bit_maps_->copy();
  if (bit_maps_->made) bit_maps_->maps.update(weights_, rect, StopToken());
}

void copyCells(const CostGrid& from, const CostGrid::Change& change, CostGrid& to) {
  to.catchUp(from, change);
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
