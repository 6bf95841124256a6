// Bricks from a whole tree.
#pragma once

#include <cstddef>

#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "mapping/map_tree.h"

namespace grid_path_planner::mapping {

// How many bricks hold a known voxel. Costs a walk over the nodes of 8 voxels and more.
std::size_t countBricks(const MapTree& tree);

// Sets in `bricks`, which are empty, every voxel that the tree knows.
void mirrorTree(const MapTree& tree, OccupancyBricks& bricks);

// The bits of a cube with an edge of 1, 2, 4 or 8 voxels set in those of its brick.
void setCube(Brick::Words& words, const Cube& cube);

// Sets the voxels of a cube in the bricks.
void fillCube(OccupancyBricks& bricks, const Cube& cube, Voxel state);

}  // namespace grid_path_planner::mapping
