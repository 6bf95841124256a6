// Numbers that say how good a path is. All look at the positions in the plane, as the map is one.
#pragma once

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::path {

// Length of the polyline in metres.
double lengthOf(const Path& path);

// Sum of the absolute changes of direction between segments, in radians; segments without a length
// are passed over.
double turningOf(const Path& path);

// The least distance in metres from the polyline to the edge of an occupied cell of `map`; 0 where
// the path meets one or touches its edge, infinity where map or path are empty. Exact but for
// rounding, not sampled. Takes time for one pass over the map and then a little a segment.
// Precondition: the positions are finite.
double clearanceOf(const Path& path, const grid::OccupancyGrid& map,
                   const grid::OccupancyThresholds& thresholds);

}  // namespace grid_path_planner::path
