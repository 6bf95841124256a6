// Shortest any-angle paths by brute force: Dijkstra over all corners at which a path can turn, with
// an edge wherever costmap/line_of_sight.h allows the straight segment; and over the points of the
// centre lattice, with a check of segments of its own.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::test {

// The length in cells of the shortest legal path between the waypoints of two passable cells; none
// where no path leads. Takes time for the square of the number of corners.
std::optional<double> shortestAnyAngle(const costmap::CostGrid& map, grid::Cell start,
                                       grid::Cell goal);

// Whether a line lies in the centre lattice of the map, whose points are the waypoints of its cells.
// In cells, from the corner of cell (0, 0). It is cut where it crosses lines of points, and the
// middle of each piece is looked at.
bool inLattice(const costmap::CostGrid& map, const Eigen::Vector2d& from,
               const Eigen::Vector2d& to);

// The length in cells of the shortest path in the centre lattice; none where there is none.
std::optional<double> shortestInLattice(const costmap::CostGrid& map, grid::Cell start,
                                        grid::Cell goal);

}  // namespace grid_path_planner::test
