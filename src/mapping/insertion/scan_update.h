// Updates a tree and its bricks with the marks of a scan.
#pragma once

#include <vector>

#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "mapping/insertion/scan_marks.h"
#include "mapping/map_tree.h"

namespace grid_path_planner::mapping {

// Updates every marked voxel once, as octomap::OcTree::updateNode does: a leaf at its clamping
// threshold stays untouched, others change by the tree's hit or miss, equal leaves are pruned. One
// traversal of the tree: a node above several voxels is visited once and not once for each.
void updateTree(MapTree& tree, OccupancyBricks& bricks, const std::vector<ScanMarks>& marks);

}  // namespace grid_path_planner::mapping
