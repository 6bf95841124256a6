#include "planners/jump_point/pruning_estimate.h"

#include <algorithm>

#include "planners/core/natural_moves.h"
#include "planners/core/steps.h"

namespace grid_path_planner::planners {

using base::StopPoll, base::StopToken;
using costmap::CostGrid, costmap::stepAllowed;
using grid::Cell, grid::CellRect, grid::GridGeometry;

namespace {

constexpr std::size_t kCells = 4096;
// Where they lie so many cells apart or more, every second one along each axis is looked at with those
// around it: half a millisecond in all.
constexpr int kFarApart = 8;

bool allEqual(const Window& window) {
  return std::all_of(window.begin(), window.end(),
                     [&window](CostGrid::Weight weight) { return weight == window[0]; });
}

}  // namespace

PruningEstimate::Count PruningEstimate::countAt(const CostGrid& map, Cell cell, bool with_steps) {
  Count count;
  const CostGrid::Weight weight = map.weight(cell);
  if (weight == CostGrid::kBlocked) return count;
  count.inverse_weight = static_cast<std::uint16_t>(kInverse / weight);
  if (!with_steps) return count;
  const Window window = windowAt(map, cell);
  if (allEqual(window)) return {4, 4, count.inverse_weight};
  const NaturalMoves natural = naturalMoves(window);
  for (unsigned step = 4; step < 8; ++step) {
    const Cell from{cell.column - kSteps[step].column, cell.row - kSteps[step].row};
    if (!stepAllowed(map, from, cell)) continue;
    const unsigned after = natural >> (8 * step) & 255U;
    ++count.steps;
    if (after != 0 && (after & ~unsigned(kNaturalInTheOpen[step])) == 0) ++count.default_only;
  }
  return count;
}

void PruningEstimate::sample(const CostGrid& map, const StopToken& stop) {
  const GridGeometry& geometry = map.geometry();
  stride_ = 1;
  while (geometry.size() / (std::size_t(stride_) * stride_) > kCells) ++stride_;
  columns_ = (geometry.width() + stride_ - 1) / stride_;
  const int rows = (geometry.height() + stride_ - 1) / stride_;
  counts_.assign(std::size_t(columns_) * rows, Count());
  steps_ = default_only_ = inverse_weights_ = passable_ = 0;
  StopPoll poll(stop, 256);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns_; ++column) {
      poll();
      replace(map, column, row);
    }
}

void PruningEstimate::update(const CostGrid& map, const CellRect& changed) {
  const CellRect near = changed.grown(1).intersection(map.geometry().rect());
  const auto firstOf = [this](int cell) { return (cell + stride_ - 1) / stride_; };
  for (int row = firstOf(near.row); row * stride_ < near.row + near.height; ++row)
    for (int column = firstOf(near.column); column * stride_ < near.column + near.width; ++column)
      replace(map, column, row);
}

void PruningEstimate::add(const Count& count, int times) {
  steps_ += times * count.steps;
  default_only_ += times * count.default_only;
  inverse_weights_ += times * count.inverse_weight;
  passable_ += count.inverse_weight != 0 ? times : 0;
}

void PruningEstimate::replace(const CostGrid& map, int column, int row) {
  Count& count = counts_[std::size_t(row) * columns_ + column];
  add(count, -1);
  const bool with_steps = stride_ < kFarApart || (column % 2 == 0 && row % 2 == 0);
  count = countAt(map, {column * stride_, row * stride_}, with_steps);
  add(count, 1);
}

}  // namespace grid_path_planner::planners
