// Whether there is memory for what a scan adds to a map.
//
//   std::vector<ScanMarks> marks;
//   MapTree tree(0.05, OctreeOptions());
//   OccupancyBricks bricks(0.05);
//   if (!fitsMemory(tree, bricks, marks, 2'000'000'000)) keepKnown(bricks, marks);
#pragma once

#include <cstddef>
#include <vector>

#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "mapping/insertion/scan_marks.h"
#include "mapping/map_tree.h"

namespace grid_path_planner::mapping {

// The most bricks that the rays of a scan of so many points may cross one by one: a few far points, a
// kilobyte of a cloud, would take gigabytes and minutes otherwise. What fits into a window is not counted.
// `memory_limit` in bytes.
std::size_t mostCrossedBricks(std::size_t points, std::size_t memory_limit);

// Throws InputError that names sensor_model/max_range where `marks` are more than `most`.
void checkCrossedBricks(const std::vector<ScanMarks>& marks, std::size_t most);

// Whether the map with the marks of a scan takes no more than `limit` bytes. Voxels that are known already count
// where a hit splits a leaf; what splits otherwise is let through up to a quarter above the limit, beyond
// which this throws InputError that names memory_limit.
bool fitsMemory(const MapTree& tree, const OccupancyBricks& bricks,
                const std::vector<ScanMarks>& marks, std::size_t limit);

// Takes the marks of voxels that are not known away, and bricks without another.
void keepKnown(const OccupancyBricks& bricks, std::vector<ScanMarks>& marks);

}  // namespace grid_path_planner::mapping
