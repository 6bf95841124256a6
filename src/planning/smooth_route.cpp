#include "grid_path_planner/planning/smooth_route.h"

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "grid_path_planner/path/smoothing.h"

namespace grid_path_planner::planning {

using base::StopToken;
using costmap::CostGrid;
using costmap::SegmentPoint;
using costmap::waypointOf;
using grid::Cell;
using path::smoothed;
using path::SmoothPath;
using planners::SearchResult;

namespace {

// The cost of what is left, infinite where nothing was done.
double smoothCells(const CostGrid& map, std::vector<Cell>& cells, std::vector<SegmentPoint>& points,
                   const StopToken& stop) {
  std::vector<SegmentPoint> all = points;
  if (all.empty())
    for (const Cell cell : cells) all.push_back(waypointOf(map, cell));
  const SmoothPath smooth = smoothed(map, all, stop);
  if (std::isinf(smooth.cost)) return smooth.cost;
  std::vector<Cell> kept_cells;
  points.clear();
  for (const std::size_t i : smooth.kept) {
    kept_cells.push_back(cells[i]);
    points.push_back(all[i]);
  }
  cells = std::move(kept_cells);
  return smooth.cost;
}

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(StopToken::Clock::now() - begin_).count();
  }

 private:
  StopToken::Clock::time_point begin_ = StopToken::Clock::now();
};

}  // namespace

void smoothResult(const CostGrid& map, SearchResult& result, const StopToken& stop) {
  const Stopwatch watch;
  const double cost = smoothCells(map, result.cells, result.points, stop);
  if (!std::isinf(cost)) {
    result.cost = {};
    result.segment_cost = cost;
  }
  result.statistics.time_s += watch.seconds();
}

void smoothRoute(Route& route, const StopToken& stop) {
  if (route.taut) return;
  const Stopwatch watch;
  std::vector<Leg> legs = route.legs;
  double cost = 0.0;
  for (Leg& leg : legs) cost += smoothCells(*leg.map, leg.cells, leg.points, stop);
  if (!std::isinf(cost)) {
    route.legs = std::move(legs);
    route.optimal = false;
    route.cost = {};
    route.segment_cost = cost;
  }
  route.statistics.time_s += watch.seconds();
}

}  // namespace grid_path_planner::planning
