// Numbers that say how good a path is.
#pragma once

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner {

// Length of the polyline in metres: in the plane, as the map is.
double lengthOf(const Path& path);

// Sum of the absolute changes of direction between segments, in radians; segments without a length
// are passed over.
double turningOf(const Path& path);

// The least distance in metres from the polyline to the edge of an occupied cell of `map`; infinity
// where the map has none, 0 where the path meets one. Exact to within a tenth of a cell: the
// polyline is sampled at that distance.
double clearanceOf(const Path& path, const OccupancyGrid& map, const OccupancyThresholds& thresholds);

}  // namespace grid_path_planner
