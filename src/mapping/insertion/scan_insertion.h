// One scan into a tree and its bricks: points to rays, rays to marks, marks to bricks, bricks to
// nodes. Keeps its memory from scan to scan.
#pragma once

#include <octomap/octomap_types.h>

#include <octomap/OcTreeKey.h>

#include <cstddef>
#include <vector>

#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "grid_path_planner/mapping/scan.h"
#include "mapping/insertion/ray.h"
#include "mapping/insertion/scan_marks.h"
#include "mapping/insertion/voxel_window.h"
#include "mapping/map_tree.h"

namespace grid_path_planner::mapping {

class ScanInsertion {
 public:
  // OctreeMap::insert's contract; `origin` is the key of the scan's origin, `memory_limit` in bytes.
  std::size_t insert(const Scan& scan, const octomap::OcTreeKey& origin, double max_range,
                     std::size_t memory_limit, MapTree& tree, OccupancyBricks& bricks);

  // False where the new voxels of the last scan were left out, for which there was no memory.
  bool fits() const { return fits_; }

  std::size_t memoryUsage() const;

 private:
  // Where a ray ends.
  struct End {
    octomap::point3d point;
    octomap::OcTreeKey key;
    bool is_hit;
  };

  std::size_t collectEnds(const Scan& scan, double max_range, const MapTree& tree);
  bool fillsItsBox(const octomap::OcTreeKey& origin, VoxelWindow::Box& box) const;
  template <class MarkRay, class MarkOrigin>
  void forEachRay(const RaySource& rays, const octomap::OcTreeKey& origin, MarkRay&& mark,
                  MarkOrigin&& mark_origin) const;
  void markWindow(const RaySource& rays, const octomap::OcTreeKey& origin,
                  const VoxelWindow::Box& box);
  void markBricks(const RaySource& rays, const octomap::OcTreeKey& origin, std::size_t most);
  void giveMarksBack();

  std::vector<End> ends_;
  VoxelWindow window_;
  std::vector<ScanMarks> marks_;
  bool fits_ = true;
};

}  // namespace grid_path_planner::mapping
