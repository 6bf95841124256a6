// Whether there is memory for what a scan adds to a map.
//
//   std::vector<ScanMarks> marks;
//   MapTree tree(0.05, OctreeOptions());
//   OccupancyBricks bricks(0.05);
//   keepWhatFits(spaceLeft(tree, bricks, marks, 2'000'000'000), bricks, marks);
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

// What of a scan there is memory for: all of it; what it says of voxels that are known; the hits among that.
enum class Space { FOR_ALL, FOR_KNOWN, FOR_HITS };

// FOR_ALL where the map with the marks takes no more than `limit` bytes. Voxels that are known already count where a
// hit splits a leaf; a miss that splits one does not, so that a map may come to take more: from a quarter above
// the limit on there is space for hits only. An obstacle in known space is never left out.
Space spaceLeft(const MapTree& tree, const OccupancyBricks& bricks,
                const std::vector<ScanMarks>& marks, std::size_t limit);

// Takes the other marks away, and bricks without one.
void keepWhatFits(Space space, const OccupancyBricks& bricks, std::vector<ScanMarks>& marks);

}  // namespace grid_path_planner::mapping
