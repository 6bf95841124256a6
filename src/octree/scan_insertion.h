// One scan into a tree and its bricks: rays to marks, marks to bricks, bricks to nodes. Keeps its
// memory from scan to scan.
#pragma once

#include <octomap/octomap_types.h>

#include <octomap/OcTreeKey.h>

#include <cstddef>
#include <vector>

#include "brick_marks.h"
#include "grid_path_planner/octree/occupancy_bricks.h"
#include "grid_path_planner/octree/scan.h"
#include "map_tree.h"
#include "voxel_tiles.h"

namespace grid_path_planner {

class RayTracer;

class ScanInsertion {
 public:
  // OctreeMap::insert's contract; `origin` is the key of the scan's origin.
  std::size_t insert(const Scan& scan, const octomap::OcTreeKey& origin, double max_range,
                     MapTree& tree, OccupancyBricks& bricks);

  std::size_t memoryUsage() const;

 private:
  std::size_t traceRays(const Scan& scan, const octomap::OcTreeKey& origin, double max_range,
                        const MapTree& tree);
  void markHits();

  VoxelTiles tiles_;
  std::vector<octomap::OcTreeKey> hits_;
  std::vector<BrickMarks> marks_;
};

}  // namespace grid_path_planner
