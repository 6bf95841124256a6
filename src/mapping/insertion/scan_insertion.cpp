#include "mapping/insertion/scan_insertion.h"

#include <algorithm>
#include <cstdlib>

#include "mapping/insertion/dense_ray_traversal.h"
#include "mapping/insertion/scan_memory.h"
#include "mapping/insertion/scan_update.h"
#include "mapping/insertion/sparse_ray_traversal.h"

namespace grid_path_planner::mapping {

namespace {

constexpr std::size_t kMostMarksKept = 1 << 18;  // for the next scan: 38 MB

}  // namespace

using octomap::OcTreeKey;
using octomap::point3d;

std::size_t ScanInsertion::insert(const Scan& scan, const OcTreeKey& origin, double max_range,
                                  std::size_t memory_limit, MapTree& tree,
                                  OccupancyBricks& bricks) {
  const std::size_t left_out = collectEnds(scan, max_range, tree);
  const RaySource rays(tree, scan.origin, origin);
  VoxelWindow::Box box;
  try {
    if (fillsItsBox(origin, box))
      markWindow(rays, origin, box);
    else
      markBricks(rays, origin, mostCrossedBricks(ends_.size(), memory_limit));
    const Space space = spaceLeft(tree, bricks, marks_, memory_limit);
    fits_ = space == Space::FOR_ALL;
    keepWhatFits(space, bricks, marks_);
    updateTree(tree, bricks, marks_);
  } catch (...) {
    window_ = {};  // where memory ran out while it was read, its cells are still marked
    giveMarksBack();
    throw;
  }
  giveMarksBack();
  return left_out;
}

void ScanInsertion::giveMarksBack() {
  if (marks_.capacity() > kMostMarksKept) std::vector<ScanMarks>().swap(marks_);
}

std::size_t ScanInsertion::memoryUsage() const {
  return ends_.capacity() * sizeof(End) + window_.memoryUsage() +
         marks_.capacity() * sizeof(ScanMarks);
}

// Returns how many points were left out.
std::size_t ScanInsertion::collectEnds(const Scan& scan, double max_range, const MapTree& tree) {
  std::size_t left_out = 0;
  ends_.clear();
  const auto collect = [&](const std::vector<point3d>& points, bool are_hits) {
    for (const point3d& point : points) {
      End end{point, {}, are_hits};
      const point3d ray = point - scan.origin;
      if (max_range >= 0.0 && !(ray.norm() <= max_range)) {
        end.point = scan.origin + ray.normalized() * static_cast<float>(max_range);
        end.is_hit = false;
      }
      if (tree.keyOf(end.point, end.key))
        ends_.push_back(end);
      else
        ++left_out;
    }
  };
  collect(scan.hits, true);
  collect(scan.clear_only, false);
  return left_out;
}

// Whether a window over all rays is worth its cells; it is read as a whole. Sets `box` to the keys
// of the rays.
bool ScanInsertion::fillsItsBox(const OcTreeKey& origin, VoxelWindow::Box& box) const {
  constexpr std::size_t kMostCells = std::size_t{1} << 26, kMostCellsPerVoxel = 16;
  box = {origin, origin};
  std::size_t voxels = 0;
  for (const End& end : ends_)
    for (unsigned axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], end.key[axis]);
      box.high[axis] = std::max(box.high[axis], end.key[axis]);
      voxels += static_cast<std::size_t>(std::abs(end.key[axis] - origin[axis]));
    }
  const std::size_t cells = VoxelWindow::cellsFor(box);
  return cells <= kMostCells && cells / kMostCellsPerVoxel <= voxels;
}

// Calls mark(ray, key of its end) for every ray that leaves the origin's voxel, mark_origin() where
// it is too short to have a direction.
template <class MarkRay, class MarkOrigin>
void ScanInsertion::forEachRay(const RaySource& rays, const OcTreeKey& origin, MarkRay&& mark,
                               MarkOrigin&& mark_origin) const {
  for (const End& end : ends_) {
    Ray ray;
    if (end.key == origin) continue;
    if (rays.rayTo(end.point, ray))
      mark(ray, end.key);
    else
      mark_origin();
  }
}

void ScanInsertion::markWindow(const RaySource& rays, const OcTreeKey& origin,
                               const VoxelWindow::Box& box) {
  window_.cover(box);
  const DenseRayTraversal traversal(window_, origin);
  forEachRay(
      rays, origin, [&](Ray& ray, const OcTreeKey& key) { traversal.mark(ray, key); },
      [&] { traversal.markOrigin(); });
  for (const End& end : ends_)  // after all rays: a hit wins
    if (end.is_hit) window_.cells()[window_.place(end.key)] = Mark::HIT;
  collectMarks(window_, marks_);
}

void ScanInsertion::markBricks(const RaySource& rays, const OcTreeKey& origin, std::size_t most) {
  marks_.clear();
  SparseRayTraversal traversal(marks_, origin);
  forEachRay(
      rays, origin,
      [&](Ray& ray, const OcTreeKey& key) {
        traversal.mark(ray, key);
        checkCrossedBricks(marks_, most);
      },
      [&] { traversal.markFree(origin); });
  for (const End& end : ends_)
    if (end.is_hit) traversal.markHit(end.key);
  std::sort(marks_.begin(), marks_.end(),
            [](const ScanMarks& a, const ScanMarks& b) { return a.order < b.order; });
}

}  // namespace grid_path_planner::mapping
