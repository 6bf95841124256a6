// Changes to many voxels of a tree that are not measurements.
#pragma once

#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "mapping/map_tree.h"

namespace grid_path_planner::mapping {

// Known voxels from `low` to `high`, both included, get the smallest log odds there are.
void freeBox(MapTree& tree, OccupancyBricks& bricks, const octomap::OcTreeKey& low,
             const octomap::OcTreeKey& high);

// Occupied leaves lose `loss` of their log odds; those no longer occupied then are forgotten.
void fadeOccupied(MapTree& tree, OccupancyBricks& bricks, float loss);

}  // namespace grid_path_planner::mapping
