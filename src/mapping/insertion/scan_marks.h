// What a scan saw of one brick, in the order in which an octree divides space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "mapping/insertion/voxel_window.h"

namespace grid_path_planner::mapping {

// The 512 voxels of a brick, by the indices of the children on the way down: a word for each child
// of the brick, in it a byte for each of that child's children, in it a bit for each voxel.
using OctantWords = std::array<std::uint64_t, 8>;

struct ScanMarks {
  BrickKey key;
  std::uint64_t order;  // the children's indices from the root down to the brick, three bits each
  OctantWords free, hit;
};

// ScanMarks::order of a brick.
std::uint64_t childrenDownTo(BrickKey key);

// The marks of a window as bricks in their order; bricks without a mark are left out, and those
// outside of space. The cells are NONE again.
void collectMarks(VoxelWindow& window, std::vector<ScanMarks>& bricks);

// The same voxels in the order of OccupancyBricks.
Brick::Words brickWords(const OctantWords& octants);

}  // namespace grid_path_planner::mapping
