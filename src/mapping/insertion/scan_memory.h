// Whether there is memory for what a scan adds to a map.
//
//   const std::vector<ScanMarks> marks;
//   MapTree tree(0.05, OctreeOptions());
//   OccupancyBricks bricks(0.05);
//   checkScanMemory(tree, bricks, marks, 2'000'000'000);  // before the tree is changed
#pragma once

#include <cstddef>
#include <vector>

#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "mapping/insertion/scan_marks.h"
#include "mapping/map_tree.h"

namespace grid_path_planner::mapping {

// The most bricks that the rays of one scan may cross one by one: a few far points, a kilobyte of a
// cloud, would take gigabytes and minutes otherwise. What fits into a window is not counted.
constexpr std::size_t kMostCrossedBricks = std::size_t{1} << 20;

// Throws InputError that names sensor_model/max_range where `marks` are more.
void checkCrossedBricks(const std::vector<ScanMarks>& marks);

// Throws InputError that names memory_limit where the map with the marks of a scan may take more than
// `limit` bytes. Voxels that are known already take no more, but where a hit splits a leaf.
void checkScanMemory(const MapTree& tree, const OccupancyBricks& bricks,
                     const std::vector<ScanMarks>& marks, std::size_t limit);

}  // namespace grid_path_planner::mapping
