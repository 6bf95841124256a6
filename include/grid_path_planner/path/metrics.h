// Measures of a path: length, turning, clearance, length by occupancy. All use the positions in the
// plane.
#pragma once

#include <string>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::path {

// Length of the polyline in metres.
double lengthOf(const Path& path);

// Sum of the absolute changes of direction between segments, in radians; segments of length 0 do
// not count.
double turningOf(const Path& path);

// The least distance in metres from the polyline to the edge of an occupied cell of `map`; 0 where
// the path meets one or touches its edge, infinity where map or path are empty. Exact but for
// rounding, not sampled. Looks only at the cells around the path, at all of them where none is
// occupied. Precondition: the positions are finite.
double clearanceOf(const Path& path, const grid::OccupancyGrid& map,
                   const grid::OccupancyThresholds& thresholds);

// "clearance 0.42 m, turning 3.3 rad" for what these two give.
std::string measuresText(double clearance, double turning);

// The least distance in metres from a straight line to the edge of a cell of one class, `limit` where
// none is nearer. `inset`, in cells: of the squares' edges, so that a line that only touches one
// meets none. Looks only at the cells around the line. Precondition: the points are finite.
double distanceToClass(const grid::Grid<grid::Occupancy>& classes, grid::Occupancy wanted,
                       const Eigen::Vector2d& from, const Eigen::Vector2d& to, double limit,
                       double inset = 0.0);

// Metres of the polyline in the plane through cells of each class; the part outside the map is in
// none. Along an edge between two cells a segment counts for the one with the larger index.
struct ClassLengths {
  double free_m = 0.0;
  double unknown_m = 0.0;
  double occupied_m = 0.0;
};

// Precondition: the positions are finite.
ClassLengths lengthsByClass(const Path& path, const grid::OccupancyGrid& map,
                            const grid::OccupancyThresholds& thresholds);
// The same where the cells' classes are known.
ClassLengths lengthsByClass(const Path& path, const grid::Grid<grid::Occupancy>& classes);

}  // namespace grid_path_planner::path
