#include "support/visibility_graph.h"

#include <cmath>
#include <limits>
#include <vector>

#include "grid_path_planner/costmap/line_of_sight.h"

namespace grid_path_planner::test {

using costmap::CostGrid;
using costmap::lineOfSight;
using costmap::SegmentPoint;
using costmap::waypointOf;
using grid::Cell;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kUnit = SegmentPoint::kUnitsPerCell;

// Corners of exactly one blocked cell: a taut path turns nowhere else.
void addCorners(const CostGrid& map, std::vector<SegmentPoint>& points) {
  for (int row = 0; row <= map.geometry().height(); ++row)
    for (int column = 0; column <= map.geometry().width(); ++column) {
      int blocked = 0;
      for (const Cell cell : {Cell{column, row}, Cell{column - 1, row}, Cell{column, row - 1},
                              Cell{column - 1, row - 1}})
        blocked += map.passable(cell) ? 0 : 1;
      if (blocked == 1) points.push_back({column * kUnit, row * kUnit});
    }
}

double distance(SegmentPoint a, SegmentPoint b) {
  return std::hypot(double(a.x - b.x), double(a.y - b.y)) / double(kUnit);
}

}  // namespace

std::optional<double> shortestAnyAngle(const CostGrid& map, Cell start, Cell goal) {
  if (start == goal) return 0.0;
  std::vector<SegmentPoint> points = {waypointOf(map, start), waypointOf(map, goal)};
  addCorners(map, points);
  std::vector<double> lengths(points.size(), kInfinity);
  std::vector<bool> done(points.size(), false);
  lengths[0] = 0.0;
  for (;;) {
    std::size_t from = points.size();
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!done[i] && lengths[i] < kInfinity &&
          (from == points.size() || lengths[i] < lengths[from]))
        from = i;
    if (from == points.size()) return std::nullopt;
    if (from == 1) return lengths[1];
    done[from] = true;
    for (std::size_t to = 0; to < points.size(); ++to) {
      if (done[to]) continue;
      const double length = lengths[from] + distance(points[from], points[to]);
      if (length < lengths[to] && lineOfSight(map, points[from], points[to])) lengths[to] = length;
    }
  }
}

}  // namespace grid_path_planner::test
