// Least costs by Boost.Graph's Dijkstra on exact pairs (A, B): what every planner is compared with.
// It shares no code with the searches and judges the steps by itself.
#pragma once

#include <optional>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::test {

// From `start` to every cell, by index; none where no path leads.
std::vector<std::optional<costmap::ExactCost>> referenceCosts(const costmap::CostGrid& map,
                                                              grid::Cell start);

}  // namespace grid_path_planner::test
