// The free cells of an occupancy map, for a decomposition into rectangles.
#pragma once

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/bit_maps.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::planners {

// A cell's bit is 1 where it is free, or unknown if that is asked for. Throws Stopped.
costmap::BitMaps freeCellsOf(const grid::OccupancyGrid& map,
                             const grid::OccupancyThresholds& thresholds, bool unknown_is_free,
                             const base::StopToken& stop);

}  // namespace grid_path_planner::planners
