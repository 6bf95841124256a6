// Smoothing: leaves out points of a polyline where a straight line past them is legal and costs no
// more.
//
//   SmoothPath smooth = smoothed(map, points, stop);
//   for (std::size_t i : smooth.kept) use(points[i]);
//
// Guaranteed: the ends stay, every segment is legal (costmap/line_of_sight.h), and none costs more
// than the part that it replaces. No new points: a path of cells' centres keeps a distance of half
// a cell from blocked cells, where the shortest path would graze them. Not guaranteed: the least
// cost that the points allow.
#pragma once

#include <cstddef>
#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/line_of_sight.h"

namespace grid_path_planner::path {

struct SmoothPath {
  std::vector<std::size_t> kept;  // of the points, in order
  double cost = 0.0;              // sum of the segments'
};

// Where a segment of the polyline is itself not legal all points are kept and the cost is infinite.
// Throws Stopped. Precondition: at least one point, each inside the map.
SmoothPath smoothed(const costmap::CostGrid& map, const std::vector<costmap::SegmentPoint>& points,
                    const base::StopToken& stop);

}  // namespace grid_path_planner::path
