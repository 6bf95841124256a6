#include "voxel_tiles.h"

namespace grid_path_planner {

VoxelTile& VoxelTiles::tileOf(const octomap::OcTreeKey& key) {
  std::array<std::uint16_t, 3> position;
  std::uint64_t packed = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    position[axis] = static_cast<std::uint16_t>(key[axis] >> VoxelTile::kEdgeBits);
    packed = packed << 16 | position[axis];
  }
  VoxelTile*& tile = by_position_[packed];
  if (tile) return *tile;
  tiles_.emplace_back();
  tile = &tiles_.back();
  tile->position = position;
  return *tile;
}

void VoxelTiles::clear() {
  tiles_.clear();
  by_position_.clear();
}

}  // namespace grid_path_planner
