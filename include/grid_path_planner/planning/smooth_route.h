// Routes and results without their zigzag (path/smoothing.h): turning points instead of cells.
#pragma once

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/planners/planner.h"
#include "grid_path_planner/planning/multi_resolution_planner.h"

namespace grid_path_planner::planning {

// The result becomes one of an any-angle planner: points, as many cells, and its cost that of the
// segments, none higher than before; left as it is where a segment between its points is not legal.
// The time is added to the statistics. Throws Stopped. Precondition: FOUND on `map`, which is
// 8-connected with diagonals of sqrt 2.
void smoothResult(const costmap::CostGrid& map, planners::SearchResult& result,
                  const base::StopToken& stop);

// Every leg by itself. Precondition as above.
void smoothRoute(Route& route, const base::StopToken& stop);

}  // namespace grid_path_planner::planning
