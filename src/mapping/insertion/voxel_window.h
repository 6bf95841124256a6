// The marks of a scan, voxel by voxel: a byte for each voxel of a box around the scan.
//
// A byte and not a bit, since marking a voxel is then a single store without a load before it. For
// scans that fill their box; see SparseRayTraversal for the others.
#pragma once

#include <octomap/octomap_types.h>

#include <octomap/OcTreeKey.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/insertion/voxel_mark.h"

namespace grid_path_planner::mapping {

class VoxelWindow {
 public:
  // A box of keys, both corners included.
  struct Box {
    octomap::OcTreeKey low, high;
  };

  // How many cells a window over `box` has.
  static std::size_t cellsFor(const Box& box);

  // Covers `box` and at least two voxels around it, for rays that overshoot by a rounding error.
  // Requires that all cells of bricks in space are NONE: their last reader clears them.
  void cover(const Box& box);
  // Sets cells to NONE that belong to no brick in space, among them the sink.
  void clearOutside();

  // Steps of one voxel along each axis, in cells.
  const std::array<std::int64_t, 3>& strides() const { return strides_; }
  std::int64_t place(const octomap::OcTreeKey& key) const {
    std::int64_t place = 0;
    for (unsigned axis = 0; axis < 3; ++axis)
      place += (static_cast<std::int64_t>(key[axis]) - 8 * low_[axis]) * strides_[axis];
    return place;
  }
  Mark* cells() { return cells_.data(); }
  // A cell of no voxel: the target of marks that are to have no effect.
  std::int64_t sink() const { return sink_; }

  // Bricks of the window, in keys >> 3; the first may lie outside of space.
  const std::array<std::int32_t, 3>& lowBrick() const { return low_; }
  const std::array<std::int32_t, 3>& bricks() const { return count_; }

  static constexpr std::int32_t kBricksAlongSpace = 1 << 13;

  std::size_t memoryUsage() const { return cells_.capacity(); }

 private:
  std::array<std::int32_t, 3> low_{}, count_{};
  std::array<std::int64_t, 3> strides_{};
  std::int64_t sink_ = 0;
  std::vector<Mark> cells_;
};

}  // namespace grid_path_planner::mapping
