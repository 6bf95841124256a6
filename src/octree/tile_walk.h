// Marks the voxels of a ray in tiles, one by one.
#pragma once

#include <octomap/octomap_types.h>

#include <octomap/OcTreeKey.h>

#include "ray.h"
#include "voxel_tiles.h"

namespace grid_path_planner {

class TileWalk {
 public:
  TileWalk(VoxelTiles& tiles, const octomap::OcTreeKey& origin)
      : tiles_(tiles), origin_(origin), tile_(&tiles.tileOf(origin)), tile_key_(origin) {}

  // Marks FREE from the origin's voxel up to that before `end`, another one.
  void mark(Ray& ray, const octomap::OcTreeKey& end) {
    Cursor cursor{*this, origin_, end, ray.forward};
    walkVoxels(ray, cursor, true);
  }

  // One voxel.
  void mark(const octomap::OcTreeKey& key, Mark mark) {
    for (unsigned axis = 0; axis < 3; ++axis)
      if ((key[axis] ^ tile_key_[axis]) >> VoxelTile::kEdgeBits) {
        tile_ = &tiles_.tileOf(key);
        tile_key_ = key;
        break;
      }
    tile_->cells[VoxelTile::place(key[0], key[1], key[2])] = mark;
  }

 private:
  struct Cursor {
    TileWalk& walk;
    octomap::OcTreeKey key, end;
    std::array<bool, 3> forward;

    void mark() { walk.mark(key, Mark::FREE); }
    void step(unsigned axis) {
      key[axis] = static_cast<octomap::key_type>(key[axis] + (forward[axis] ? 1 : -1));
    }
    bool atEnd() const { return key == end; }
  };

  VoxelTiles& tiles_;
  octomap::OcTreeKey origin_;
  VoxelTile* tile_;
  octomap::OcTreeKey tile_key_;
};

}  // namespace grid_path_planner
