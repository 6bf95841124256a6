// Marks the voxels of a ray in the bricks that it touches, one by one (Amanatides & Woo 1987).
//
// For scans whose rays touch few voxels of the box around them, such as a few long rays: memory is
// proportional to the bricks touched. DenseRayTraversal is faster where a window fits.
#pragma once

#include <octomap/octomap_types.h>

#include <octomap/OcTreeKey.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mapping/insertion/ray.h"
#include "mapping/insertion/scan_marks.h"

namespace grid_path_planner::mapping {

class SparseRayTraversal {
 public:
  // Adds to `bricks`, which is empty, in no order.
  SparseRayTraversal(std::vector<ScanMarks>& bricks, const octomap::OcTreeKey& origin)
      : bricks_(bricks), origin_(origin) {}

  // Marks free from the origin's voxel up to that before `end`, another one.
  void mark(Ray& ray, const octomap::OcTreeKey& end) {
    Cursor cursor{*this, origin_, end, ray.forward};
    traverseVoxels(ray, cursor, true);
  }

  void markFree(const octomap::OcTreeKey& key) {
    const Bit bit = bitOf(key);
    brickOf(key).free[bit.octant] |= bit.mask;
  }

  // A hit is not free.
  void markHit(const octomap::OcTreeKey& key) {
    const Bit bit = bitOf(key);
    ScanMarks& brick = brickOf(key);
    brick.free[bit.octant] &= ~bit.mask;
    brick.hit[bit.octant] |= bit.mask;
  }

 private:
  struct Cursor {
    SparseRayTraversal& traversal;
    octomap::OcTreeKey key, end;
    std::array<bool, 3> forward;

    void mark() { traversal.markFree(key); }
    void step(unsigned axis) {
      key[axis] = static_cast<octomap::key_type>(key[axis] + (forward[axis] ? 1 : -1));
    }
    bool atEnd() const { return key == end; }
  };

  // A voxel in OctantWords.
  struct Bit {
    unsigned octant;
    std::uint64_t mask;
  };

  static Bit bitOf(const octomap::OcTreeKey& key) {
    const auto child = [&](int level) { return octomap::computeChildIdx(key, level); };
    return {child(2), std::uint64_t{1} << (8 * child(1) + child(0))};
  }

  ScanMarks& brickOf(const octomap::OcTreeKey& voxel) {
    const BrickKey key = BrickKey::of(voxel);
    const std::uint64_t order = mortonCode(key);
    if (!bricks_.empty() && bricks_[last_].order == order) return bricks_[last_];
    const auto entry = by_order_.emplace(order, bricks_.size());
    if (entry.second) bricks_.push_back({key, order, {}, {}});
    last_ = entry.first->second;
    return bricks_[last_];
  }

  std::vector<ScanMarks>& bricks_;
  octomap::OcTreeKey origin_;
  std::unordered_map<std::uint64_t, std::size_t> by_order_;
  std::size_t last_ = 0;
};

}  // namespace grid_path_planner::mapping
