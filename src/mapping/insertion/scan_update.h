// Brings a tree and its bricks up to date with what a scan saw.
#pragma once

#include <vector>

#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "mapping/insertion/scan_marks.h"
#include "mapping/map_tree.h"

namespace grid_path_planner::mapping {

// Every marked voxel once, as octomap::OcTree::updateNode does: a leaf that is as sure as can be of
// what was seen stays untouched, others change by the tree's hit or miss, equal leaves are pruned.
// One walk over the tree: a node above several voxels is looked at once and not once for each.
void updateTree(MapTree& tree, OccupancyBricks& bricks, const std::vector<ScanMarks>& marks);

}  // namespace grid_path_planner::mapping
