// The cells to which a path exists, whatever it costs.
//
//   std::vector<std::uint8_t> reached = reachableFrom(map, start, stop);
//   if (reached[map.geometry().index(goal).value()] == 0) use("no path");
#pragma once

#include <cstdint>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planners {

// The cells that can be reached from `start` by steps, start included if it is passable: a byte a
// cell, not 0 where reached. Throws Stopped.
std::vector<std::uint8_t> reachableFrom(const costmap::CostGrid& map, grid::Cell start,
                                        const base::StopToken& stop);

}  // namespace grid_path_planner::planners
