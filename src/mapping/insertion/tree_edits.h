// Changes to many voxels of a tree other than by scans: clearing a box, decay.
#pragma once

#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "mapping/map_tree.h"

namespace grid_path_planner::mapping {

// Sets known voxels from `low` to `high`, both included, to the smallest log odds (clamping
// threshold).
void freeBox(MapTree& tree, OccupancyBricks& bricks, const octomap::OcTreeKey& low,
             const octomap::OcTreeKey& high);

// Lowers the log odds of occupied leaves by `loss`; leaves no longer occupied become unknown.
void fadeOccupied(MapTree& tree, OccupancyBricks& bricks, float loss);

}  // namespace grid_path_planner::mapping
