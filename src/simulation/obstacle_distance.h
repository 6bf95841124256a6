// How far a point is from the obstacles of a map.
#pragma once

#include <Eigen/Core>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::simulation {

// Metres from `position` (map frame) to the nearest edge of a cell of at least `occupied_min`; 0
// inside one. Cells farther than `reach` metres do not count: `reach` where all are.
double obstacleDistance(const grid::OccupancyGrid& map, int occupied_min,
                        const Eigen::Vector2d& position, double reach);

}  // namespace grid_path_planner::simulation
