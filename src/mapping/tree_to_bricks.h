// Bricks from a whole tree.
#pragma once

#include <cstddef>

#include "grid_path_planner/mapping/occupancy_bricks.h"
#include "mapping/map_tree.h"

namespace grid_path_planner::mapping {

// How many bricks hold a known voxel. Visits the nodes with an edge of 8 voxels and more.
std::size_t countBricks(const MapTree& tree);

// The bytes that treeToBricks() would take: a column takes some from its lowest to its highest brick,
// so that a few nodes can ask for a lot. Precondition: countBricks() is small enough to hold, and there
// are as many bytes left to find out as bytesToMeasureBricks() says.
std::size_t bytesOfBricks(const MapTree& tree);
std::size_t bytesToMeasureBricks(const MapTree& tree);

// Sets every known voxel of the tree in `bricks`, which are empty.
void treeToBricks(const MapTree& tree, OccupancyBricks& bricks);

// Sets the bits of a cube with an edge of 1, 2, 4 or 8 voxels in `words` of its brick.
void setCube(Brick::Words& words, const Cube& cube);

// Sets the voxels of a cube in the bricks.
void fillCube(OccupancyBricks& bricks, const Cube& cube, Voxel state);

}  // namespace grid_path_planner::mapping
