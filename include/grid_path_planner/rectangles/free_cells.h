// Which cells of an occupancy map rectangles are cut from.
#pragma once

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/terrain/bit_maps.h"

namespace grid_path_planner {

// A cell's bit is 1 where it is free, or unknown if that is asked for. Throws Stopped.
BitMaps freeCellsOf(const OccupancyGrid& map, const OccupancyThresholds& thresholds,
                    bool unknown_is_free, const StopToken& stop);

}  // namespace grid_path_planner
