// Brings a tree and its bricks up to date with what a scan saw.
#pragma once

#include <vector>

#include "brick_marks.h"
#include "grid_path_planner/octree/occupancy_bricks.h"
#include "map_tree.h"

namespace grid_path_planner {

// Every marked voxel once, as octomap::OcTree::updateNode does: a leaf that is as sure as can be of
// what was seen stays untouched, others change by the tree's hit or miss, equal leaves are pruned.
// One walk over the tree: a node above several voxels is looked at once and not once for each.
void updateTree(MapTree& tree, OccupancyBricks& bricks, const std::vector<BrickMarks>& marks);

}  // namespace grid_path_planner
