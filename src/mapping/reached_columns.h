// Which columns of the 3-D map lie near others: those whose seabed may be another one than before.
//
// Guaranteed: memory for as many columns as the map has, and work in proportion to these and to the rows that
// changed, however far they reach.
#pragma once

#include <vector>

#include "grid_path_planner/mapping/occupancy_bricks.h"

namespace grid_path_planner::mapping {

// Every column with a known voxel that lies within `reach` brick columns, along x and along y, of one of `places`;
// some of them several times, and maybe some without a known voxel. In no particular order.
std::vector<BrickColumn> reachedColumns(const OccupancyBricks& bricks,
                                        std::vector<BrickColumn> places, int reach);

}  // namespace grid_path_planner::mapping
