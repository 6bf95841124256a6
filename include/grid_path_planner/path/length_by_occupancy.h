// How much of a path lies where.
#pragma once

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::path {

// Metres of the polyline in the plane through cells of each class; what lies outside the map is in
// none. Along an edge between two cells a segment counts for the one with the larger index.
struct ClassLengths {
  double free_m = 0.0;
  double unknown_m = 0.0;
  double occupied_m = 0.0;
};

// Precondition: the positions are finite.
ClassLengths lengthsByClass(const Path& path, const grid::OccupancyGrid& map,
                            const grid::OccupancyThresholds& thresholds);

}  // namespace grid_path_planner::path
