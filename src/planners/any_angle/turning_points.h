// The turning points of an any-angle path, moved to where the path costs less.
//
//   cells = tightened(map, cells, stop);
//
// By turns: each turning point climbs down over the cells around it, in steps that halve, is left out
// where a straight line past it costs no more, and a segment is bent in its middle where that costs less.
//
// Guaranteed: the ends stay, every segment is legal (costmap/line_of_sight.h), and the path costs no
// more. Not guaranteed: the least cost near the path; the end is a local minimum, or a number of rounds.
#pragma once

#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"

namespace grid_path_planner::planners {

// Throws Stopped. Preconditions: the segments are legal, the map has several weights.
std::vector<grid::Cell> tightened(const costmap::CostGrid& map, std::vector<grid::Cell> cells,
                                  const base::StopToken& stop);

// The sum of the segments' costs; infinite where one is not legal.
double costOfTurningPoints(const costmap::CostGrid& map, const std::vector<grid::Cell>& cells);

}  // namespace grid_path_planner::planners
