// Ray traversal of a voxel grid (Amanatides & Woo, "A fast voxel traversal algorithm for ray
// tracing", 1987), with the arithmetic of octomap::OcTree::computeRayKeys: the same sums in the same
// order and precision, so that ties and rounding errors are the same.
#pragma once

#include <octomap/octomap_types.h>

#include <octomap/OcTreeKey.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mapping/map_tree.h"

namespace grid_path_planner::mapping {

// By axis: where the ray next crosses a border (tMax of Amanatides & Woo) and the distance from one
// border to the next (tDelta), as lengths along the ray in metres.
struct Ray {
  std::array<double, 3> next, between;
  std::array<bool, 3> forward;
  double length;
};

// The rays of one scan.
class RaySource {
 public:
  RaySource(const MapTree& tree, const octomap::point3d& origin, const octomap::OcTreeKey& key)
      : origin_(origin), resolution_(tree.getResolution()) {
    for (unsigned axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        double border = tree.keyToCoord(key[axis]);
        border += static_cast<float>(step * resolution_ * 0.5);
        border_[axis][step > 0] = border - origin(axis);
      }
  }

  // The ray to a point in another voxel. False where the point is so near that single precision has
  // no direction for it.
  bool rayTo(const octomap::point3d& end, Ray& ray) const {
    octomap::point3d direction = end - origin_;
    const float length = static_cast<float>(direction.norm());
    if (!(length > 0.0f)) return false;
    direction /= length;
    ray.length = length;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const float along = direction(axis);
      constexpr double kNever = std::numeric_limits<double>::max();
      ray.forward[axis] = along > 0.0f;
      ray.next[axis] = along == 0.0f ? kNever : border_[axis][along > 0.0f] / along;
      ray.between[axis] = along == 0.0f ? kNever : resolution_ / std::fabs(along);
    }
    return true;
  }

 private:
  octomap::point3d origin_;
  double resolution_;
  // Distance of the borders of the origin's voxel, along each axis backward and forward.
  std::array<std::array<double, 2>, 3> border_;
};

// Moves `cursor` from its voxel to the last voxel before the end, border by border. `cursor` has
// mark() for its voxel, step(axis) and atEnd(). `at_origin`: the first voxel is marked however short
// the ray.
template <class Cursor>
void traverseVoxels(Ray& ray, Cursor& cursor, bool at_origin) {
  auto& next = ray.next;
  while (at_origin || (!cursor.atEnd() && !(std::min({next[0], next[1], next[2]}) > ray.length))) {
    at_origin = false;
    cursor.mark();
    const unsigned axis =
        next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    next[axis] += ray.between[axis];
    cursor.step(axis);
  }
}

}  // namespace grid_path_planner::mapping
