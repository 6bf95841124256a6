#include "planners/replanning/outdated_cells.h"

namespace grid_path_planner::planners {

using base::StopPoll;
using grid::CellRect, grid::GridGeometry;

namespace {

constexpr int kTile = 32;

int tilesAlong(int cells) {
  return (cells + kTile - 1) / kTile;
}

}  // namespace

void OutdatedCells::clear() {
  marked_.clear();
  added_.clear();
  removed();
}

void OutdatedCells::removed() {
  found_.clear();
  cells_ = std::vector<Index>();
  visited_ = 0;
}

void OutdatedCells::restart() {
  for (const Tile tile : found_) mark(tile);
  removed();
}

void OutdatedCells::mark(Tile tile) {
  if (marked_[tile] != 0) return;
  marked_[tile] = 1;
  added_.push_back(tile);
}

void OutdatedCells::add(const BackwardNodes& nodes, const CellRect& rect) {
  if (marked_.empty()) {
    const GridGeometry& map = nodes.geometry();
    columns_ = tilesAlong(map.width());
    marked_.resize(static_cast<std::size_t>(columns_) *
                   static_cast<std::size_t>(tilesAlong(map.height())));
  }
  for (int row = rect.row / kTile; row <= (rect.row + rect.height - 1) / kTile; ++row)
    for (int column = rect.column / kTile; column <= (rect.column + rect.width - 1) / kTile;
         ++column)
      mark(static_cast<Tile>(row * columns_ + column));
}

void OutdatedCells::find(const BackwardNodes& nodes, StopPoll& poll) {
  while (!added_.empty()) {
    const Tile tile = added_.back();
    addInconsistent(nodes, tile, poll);
    found_.push_back(tile);
    marked_[tile] = 0;
    added_.pop_back();
  }
  for (; visited_ < cells_.size(); ++visited_) {
    poll();
    addChildren(nodes, cells_[visited_]);
  }
}

void OutdatedCells::addInconsistent(const BackwardNodes& nodes, Tile tile, StopPoll& poll) {
  const int column = static_cast<int>(tile) % columns_ * kTile;
  const int row = static_cast<int>(tile) / columns_ * kTile;
  const CellRect cells = CellRect{column, row, kTile, kTile}.intersection(nodes.geometry().rect());
  for (int r = row; r < row + cells.height; ++r) {
    poll();
    auto index = static_cast<Index>(nodes.geometry().index({column, r}).value());
    for (int c = 0; c < cells.width; ++c, ++index)
      if (nodes.known(index) && !nodes.consistent(index)) cells_.push_back(index);
  }
}

// The neighbours whose paths lead over the cell; inconsistent ones were added by themselves.
void OutdatedCells::addChildren(const BackwardNodes& nodes, Index index) {
  for (unsigned mask = nodes.stepsFrom(index); mask != 0; mask &= mask - 1) {
    const auto step = static_cast<std::uint32_t>(__builtin_ctz(mask));
    const Index other = nodes.along(index, step);
    if (other == nodes.root() || !nodes.known(other)) continue;
    if (nodes.stepOf(other) == oppositeStep(step) && nodes.consistent(other))
      cells_.push_back(other);
  }
}

}  // namespace grid_path_planner::planners
