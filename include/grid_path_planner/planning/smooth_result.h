// Search results smoothed (path/smoothing.h), without zigzags: turning points instead of cells.
#pragma once

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/planners/planner.h"

namespace grid_path_planner::planning {

// The result becomes one of an any-angle planner: points, as many cells, and the cost of the
// segments between them: no higher than before, but for zigzags of which the rounding of weights is
// the cause, whose straight lines cost at most their length in cells more. Returns false, and leaves
// all but the time as it is, where a segment between the result's points is not legal. The time is
// added to the statistics. Throws Stopped. Precondition: FOUND on `map`, which is 8-connected with
// diagonals of sqrt 2.
bool smoothResult(const costmap::CostGrid& map, planners::SearchResult& result,
                  const base::StopToken& stop);

}  // namespace grid_path_planner::planning
