// How far a footprint reaches into occupied cells at poses close to one another along a path, by Boost.Geometry: shares no code
// with vehicle.
#pragma once

#include <vector>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/path/headings.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::test {

// The largest area, in cells, that the polygon of `corners` (m, base_link) shares with a cell of at least 65, at poses every `step`
// metres of the path and every 3 degrees of the turns on the spot between their headings, from `start_yaw` on.
double largestOverlap(const std::vector<Eigen::Vector2d>& corners, const path::Path& path,
                      double start_yaw, path::HeadingMode mode, double step,
                      const grid::OccupancyGrid& map);

}  // namespace grid_path_planner::test
