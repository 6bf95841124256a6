// Marks the voxels between a sensor and what it saw: those of octomap::OcTree::computeRayKeys, to
// the last one.
//
// A ray runs slab by slab along the axis it advances fastest on. In a slab it crosses at most one
// border on each other axis, so a slab is up to three voxels, found without a branch that depends
// on the ray; only its end and rays very near to a diagonal go voxel by voxel. The times of the
// crossings are summed in OctoMap's order, so that ties and errors of rounding fall alike.
#pragma once

#include <octomap/octomap_types.h>

#include <octomap/OcTreeKey.h>

#include <array>
#include <cstdint>

#include "map_tree.h"
#include "voxel_tiles.h"

namespace grid_path_planner {

class RayTracer {
 public:
  // Rays begin at `origin`, in the voxel `key`. `tiles` must outlive this object.
  RayTracer(const MapTree& tree, const octomap::point3d& origin, const octomap::OcTreeKey& key,
            VoxelTiles& tiles);

  // Marks FREE from the origin's voxel up to that before `end`, which lies in the voxel `key`;
  // nothing where this is the origin's own.
  void trace(const octomap::point3d& end, const octomap::OcTreeKey& key);

 private:
  struct Walk;

  template <unsigned kMajor>
  void walkSlabs(Walk& walk) const;
  void walkVoxels(Walk& walk, bool at_origin) const;
  void move(Walk& walk, unsigned axis) const;

  octomap::point3d origin_;
  octomap::OcTreeKey key_;
  double resolution_;
  // Of the origin's voxel along each axis, backward and forward: distance of its border.
  std::array<std::array<double, 2>, 3> border_;
  VoxelTiles& tiles_;
  VoxelTile& first_tile_;
};

}  // namespace grid_path_planner
