#include "planners/replanning/outdated_cells.h"

#include <algorithm>

namespace grid_path_planner::planners {

using base::StopPoll;
using grid::CellRect;

namespace {

// So many are compacted at no notable cost.
constexpr std::size_t kFew = 4096;

}  // namespace

void OutdatedCells::clear() {
  added_.clear();
  removed();
}

void OutdatedCells::removed() {
  first_.clear();
  cells_ = std::vector<Index>();
  visited_ = 0;
}

void OutdatedCells::restart() {
  added_.insert(added_.end(), first_.begin(), first_.end());
  removed();
}

void OutdatedCells::add(const BackwardNodes& nodes, const CellRect& rect) {
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column) {
      const auto index = static_cast<Index>(nodes.geometry().index({column, row}).value());
      if (nodes.known(index) && !nodes.consistent(index)) added_.push_back(index);
    }
  if (added_.size() > 2 * compacted_ + kFew) compact(nodes);
}

void OutdatedCells::find(const BackwardNodes& nodes, StopPoll& poll) {
  takeAdded(nodes);
  for (; visited_ < cells_.size(); ++visited_) {
    poll();
    addChildren(nodes, cells_[visited_]);
  }
}

// Each once, and none that is right again.
void OutdatedCells::compact(const BackwardNodes& nodes) {
  const auto right = [&](Index index) { return !nodes.known(index) || nodes.consistent(index); };
  std::sort(added_.begin(), added_.end());
  added_.erase(std::unique(added_.begin(), added_.end()), added_.end());
  added_.erase(std::remove_if(added_.begin(), added_.end(), right), added_.end());
  compacted_ = added_.size();
}

void OutdatedCells::takeAdded(const BackwardNodes& nodes) {
  compact(nodes);
  first_.insert(first_.end(), added_.begin(), added_.end());
  cells_.insert(cells_.end(), added_.begin(), added_.end());
  added_.clear();
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
