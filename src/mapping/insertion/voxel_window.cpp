#include "mapping/insertion/voxel_window.h"

#include <algorithm>

namespace grid_path_planner::mapping {
namespace {

constexpr std::int32_t kMargin = 2;  // voxels

std::int32_t lowestBrick(octomap::key_type key) {
  return (key - kMargin) >> 3;
}
std::int32_t highestBrick(octomap::key_type key) {
  return (key + kMargin) >> 3;
}

}  // namespace

std::size_t VoxelWindow::cellsFor(const Box& box) {
  std::size_t cells = 1;
  for (unsigned axis = 0; axis < 3; ++axis)
    cells *= 8u * static_cast<std::size_t>(highestBrick(box.high[axis]) -
                                           lowestBrick(box.low[axis]) + 1);
  return cells;
}

void VoxelWindow::cover(const Box& box) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    low_[axis] = lowestBrick(box.low[axis]);
    count_[axis] = highestBrick(box.high[axis]) - low_[axis] + 1;
  }
  strides_[2] = 1;
  strides_[1] = 8 * count_[2];
  strides_[0] = 8 * count_[1] * strides_[1];
  sink_ = 8 * count_[0] * strides_[0];
  cells_.resize(static_cast<std::size_t>(sink_) + 1);
}

void VoxelWindow::clearOutside() {
  cells_[static_cast<std::size_t>(sink_)] = Mark::NONE;
  for (unsigned axis = 0; axis < 3; ++axis)
    if (low_[axis] < 0 || low_[axis] + count_[axis] > kBricksAlongSpace)
      std::fill(cells_.begin(), cells_.end(), Mark::NONE);
}

}  // namespace grid_path_planner::mapping
