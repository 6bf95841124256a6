// The shortest path through a sequence of borders: the funnel algorithm (Lee & Preparata 1984,
// Chazelle 1982) on lattice points, or on the centres of cells.
#pragma once

#include <vector>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "planners/rectangles/rectangle_route.h"

namespace grid_path_planner::planners {

// The turning points of the shortest path from `start` to `goal` that crosses the borders of
// `route` in their order, both ends included. It stays inside the rectangles of the route.
// With `lattice` it stays in the centre lattice of that map (costmap/line_of_sight.h): a border is
// crossed between two centres of the cells on either side. Preconditions: `start` lies in the
// route's first rectangle, `goal` in its last; with `lattice` both are waypoints of cells.
std::vector<costmap::SegmentPoint> shortestThrough(const RectangleGraph& map,
                                                   const RectangleRoute& route,
                                                   costmap::SegmentPoint start,
                                                   costmap::SegmentPoint goal,
                                                   const costmap::CostGrid* lattice = nullptr);

}  // namespace grid_path_planner::planners
