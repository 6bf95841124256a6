// Zigzags of a smoothed path, made straight.
//
//   const SmoothPath calm = withoutZigzags(map, points, smoothed(map, points, stop), stop);
//
// Weights are rounded to whole numbers, so that the cells of least weight along the middle of a
// passage that is not parallel to the grid are a staircase, and so is the path of least cost: with
// weights rounded ten times as finely it is straight. Guaranteed: the ends stay, every segment is
// legal (costmap/line_of_sight.h), points are left out only where the path turned to and fro within
// a cell of the line that replaces it, and that line costs at most its length in cells more, which
// is what rounding and the cost of a line (the larger of the weights beside it) hide. A map of one
// weight has nothing to round: its paths stay as they are.
#pragma once

#include <vector>

#include "grid_path_planner/base/stop_token.h"
#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/path/smoothing.h"

namespace grid_path_planner::path {

// `path`: as smoothed() gives it for these points; one of infinite cost stays. Throws Stopped.
SmoothPath withoutZigzags(const costmap::CostGrid& map,
                          const std::vector<costmap::SegmentPoint>& points, SmoothPath path,
                          const base::StopToken& stop);

}  // namespace grid_path_planner::path
