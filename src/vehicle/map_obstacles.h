// The cells of a map that a vehicle must not meet.
#pragma once

#include "grid_path_planner/grid/occupancy.h"
#include "vehicle/sweep.h"

namespace grid_path_planner::vehicle {

// Occupied cells; with `unknown` also unknown ones and what lies outside the map, which must outlive the obstacles.
FootprintObstacles mapObstacles(const grid::OccupancyGrid& map,
                                const grid::OccupancyThresholds& thresholds, bool unknown);

}  // namespace grid_path_planner::vehicle
