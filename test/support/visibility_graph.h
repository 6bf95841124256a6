// Shortest any-angle paths by brute force: Dijkstra over all corners at which a path can turn, with
// an edge wherever costmap/line_of_sight.h allows the straight segment.
#pragma once

#include <optional>

#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::test {

// The length in cells of the shortest legal path between the waypoints of two passable cells; none
// where no path leads. Takes time for the square of the number of corners.
std::optional<double> shortestAnyAngle(const costmap::CostGrid& map, grid::Cell start,
                                       grid::Cell goal);

}  // namespace grid_path_planner::test
