// Marks the voxels of a ray in a window: ray traversal by slabs along the major axis.
//
// A ray's major axis is the one along which it advances fastest. Between two borders of this axis
// the ray crosses at most one border of each other axis, so a slab is up to three voxels, found
// without a branch that depends on the ray; so is the last slab. Rays very near to a diagonal, and
// rays that rounding errors lead past their end, go voxel by voxel (traverseVoxels).
#pragma once

#include <cstdint>

#include "mapping/insertion/ray.h"
#include "mapping/insertion/voxel_window.h"

namespace grid_path_planner::mapping {

class DenseRayTraversal {
 public:
  // Rays begin in the voxel `origin`. `window` covers it and every end.
  DenseRayTraversal(VoxelWindow& window, const octomap::OcTreeKey& origin)
      : window_(window), origin_(window.place(origin)) {
    key_ = origin;
  }

  // Marks FREE from the origin's voxel up to that before `end`, another one.
  void mark(Ray& ray, const octomap::OcTreeKey& end) const;

  // Marks the origin's voxel.
  void markOrigin() const { window_.cells()[origin_] = Mark::FREE; }

 private:
  template <unsigned kMajor>
  void markSlabs(Ray& ray, std::int64_t slabs, std::int64_t end) const;
  void markVoxels(Ray& ray, std::int64_t place, std::int64_t end, bool at_origin) const;

  VoxelWindow& window_;
  octomap::OcTreeKey key_;
  std::int64_t origin_;
};

}  // namespace grid_path_planner::mapping
