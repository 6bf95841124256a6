#include "scan_insertion.h"

#include "ray_tracer.h"
#include "scan_update.h"

namespace grid_path_planner {

using octomap::OcTreeKey;
using octomap::point3d;

std::size_t ScanInsertion::insert(const Scan& scan, const OcTreeKey& origin, double max_range,
                                  MapTree& tree, OccupancyBricks& bricks) {
  const std::size_t left_out = traceRays(scan, origin, max_range, tree);
  markHits();
  collectMarks(tiles_, marks_);
  tiles_.clear();
  updateTree(tree, bricks, marks_);
  return left_out;
}

std::size_t ScanInsertion::memoryUsage() const {
  return tiles_.memoryUsage() + hits_.capacity() * sizeof hits_[0] +
         marks_.capacity() * sizeof marks_[0];
}

// Gives how many points were left out.
std::size_t ScanInsertion::traceRays(const Scan& scan, const OcTreeKey& origin, double max_range,
                                     const MapTree& tree) {
  RayTracer tracer(tree, scan.origin, origin, tiles_);
  std::size_t left_out = 0;
  hits_.clear();
  const auto trace = [&](const point3d& point, bool is_hit) {
    const point3d ray = point - scan.origin;
    const bool reached = max_range < 0.0 || ray.norm() <= max_range;
    const point3d end =
        reached ? point : scan.origin + ray.normalized() * static_cast<float>(max_range);
    OcTreeKey key;
    if (!tree.keyOf(end, key)) {
      ++left_out;
      return;
    }
    tracer.trace(end, key);
    if (is_hit && reached) hits_.push_back(key);
  };
  for (const point3d& point : scan.hits) trace(point, true);
  for (const point3d& point : scan.clear_only) trace(point, false);
  return left_out;
}

// After all rays: a hit wins.
void ScanInsertion::markHits() {
  VoxelTile* tile = nullptr;
  OcTreeKey last(0, 0, 0);
  for (const OcTreeKey& key : hits_) {
    bool same_tile = tile != nullptr;
    for (unsigned axis = 0; axis < 3; ++axis)
      same_tile &= key[axis] >> VoxelTile::kEdgeBits == last[axis] >> VoxelTile::kEdgeBits;
    if (!same_tile) tile = &tiles_.tileOf(key);
    tile->cells[VoxelTile::place(key[0], key[1], key[2])] = Mark::HIT;
    last = key;
  }
}

}  // namespace grid_path_planner
