// The least distance of a polyline to what it keeps away from, by Boost.Geometry: an independent
// judge of published paths, which shares no code with what it judges.
//
//   KeptFrom from;                                  // occupied cells
//   from.unknown = true;                            // and unknown ones
//   double least = leastDistance(points, map, from, 2.0);
#pragma once

#include <Eigen/Core>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::test {

struct KeptFrom {
  bool occupied = true;  // values from 65 on
  bool unknown = false;  // values that are neither 0..25 nor from 65 on
  bool border = false;   // everything outside the map
};

// In metres, to the squares of the cells of `map` and to its outside; `limit` where nothing is
// nearer. 0 where the polyline meets one.
double leastDistance(const std::vector<Eigen::Vector2d>& points, const grid::OccupancyGrid& map,
                     const KeptFrom& from, double limit);

}  // namespace grid_path_planner::test
