#include "grid_path_planner/planning/smooth_result.h"

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "grid_path_planner/path/smoothing.h"
#include "path/zigzags.h"

namespace grid_path_planner::planning {

using base::StopToken;
using costmap::CostGrid, costmap::SegmentPoint, costmap::waypointOf;
using grid::Cell;
using path::smoothed, path::SmoothPath, path::withoutZigzags;
using planners::SearchResult;

namespace {

std::vector<SegmentPoint> pointsOf(const CostGrid& map, const SearchResult& result) {
  std::vector<SegmentPoint> points = result.points;
  if (points.empty())
    for (const Cell cell : result.cells) points.push_back(waypointOf(map, cell));
  return points;
}

bool smoothUntimed(const CostGrid& map, SearchResult& result, const StopToken& stop) {
  const std::vector<SegmentPoint> points = pointsOf(map, result);
  const SmoothPath smooth = withoutZigzags(map, points, smoothed(map, points, stop), stop);
  if (std::isinf(smooth.cost)) return false;
  std::vector<Cell> kept_cells;
  result.points.clear();
  for (const std::size_t i : smooth.kept) {
    kept_cells.push_back(result.cells[i]);
    result.points.push_back(points[i]);
  }
  result.cells = std::move(kept_cells);
  result.cost = {};
  result.segment_cost = smooth.cost;
  return true;
}

}  // namespace

bool smoothResult(const CostGrid& map, SearchResult& result, const StopToken& stop) {
  const auto begin = StopToken::Clock::now();
  const bool smooth = smoothUntimed(map, result, stop);
  result.statistics.time_s +=
      std::chrono::duration<double>(StopToken::Clock::now() - begin).count();
  return smooth;
}

}  // namespace grid_path_planner::planning
