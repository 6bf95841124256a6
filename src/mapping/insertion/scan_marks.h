// The voxels of one brick that a scan observed, in the order in which an octree divides space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "mapping/insertion/voxel_window.h"

namespace grid_path_planner::mapping {

// The 512 voxels of a brick, by child indices from the brick down: a word for each child of the
// brick, in it a byte for each of that child's children, in it a bit for each voxel.
using OctantWords = std::array<std::uint64_t, 8>;

struct ScanMarks {
  BrickKey key;
  std::uint64_t order;  // Morton code: child indices from the root to the brick, three bits each
  OctantWords free, hit;
};

// The Morton code of a brick: its ScanMarks::order.
std::uint64_t mortonCode(BrickKey key);

// The marks of a window as bricks in Morton order, without bricks that have no mark or lie outside
// of space. The cells are NONE again afterwards.
void collectMarks(VoxelWindow& window, std::vector<ScanMarks>& bricks);

// The same voxels in the bit order of OccupancyBricks, and back.
Brick::Words brickWords(const OctantWords& octants);
OctantWords octantWords(const Brick::Words& words);

}  // namespace grid_path_planner::mapping
