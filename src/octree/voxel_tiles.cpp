#include "voxel_tiles.h"

namespace grid_path_planner {

VoxelTile& VoxelTiles::tileOf(const octomap::OcTreeKey& key) {
  std::array<std::uint16_t, 3> position;
  for (unsigned axis = 0; axis < 3; ++axis)
    position[axis] = static_cast<std::uint16_t>(key[axis] >> VoxelTile::kEdgeBits);
  return tileAt(position);
}

void VoxelTiles::clear() {
  by_position_.clear();
  used_.clear();
  if (pool_.size() > kKept) pool_.resize(kKept);
}

VoxelTile& VoxelTiles::tileAt(const std::array<std::uint16_t, 3>& position) {
  const std::uint64_t key =
      std::uint64_t{position[0]} << 32 | std::uint64_t{position[1]} << 16 | position[2];
  VoxelTile*& tile = by_position_[key];
  if (tile) return *tile;
  if (used_.size() == pool_.size()) pool_.emplace_back();
  tile = &pool_[used_.size()];
  used_.push_back(tile);
  tile->position = position;
  tile->neighbors.fill(nullptr);
  return *tile;
}

VoxelTile& VoxelTiles::lookUpNeighbor(const VoxelTile& tile, unsigned axis, bool forward) {
  std::array<std::uint16_t, 3> position = tile.position;
  position[axis] =
      static_cast<std::uint16_t>((position[axis] + (forward ? 1 : -1)) & kLastPosition);
  return tileAt(position);
}

}  // namespace grid_path_planner
