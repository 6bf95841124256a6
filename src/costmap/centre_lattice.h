// The centre lattice of line_of_sight.h for any two points, those of partial blocks included.
#pragma once

#include "grid_path_planner/costmap/line_of_sight.h"

namespace grid_path_planner::costmap {

// Whether the line lies in the lattice; from = to: whether the point does. Exact.
bool inCentreLattice(const CostGrid& map, SegmentPoint from, SegmentPoint to);

}  // namespace grid_path_planner::costmap
