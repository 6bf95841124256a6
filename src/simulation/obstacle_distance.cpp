#include "simulation/obstacle_distance.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::simulation {

using grid::Cell;
using grid::OccupancyGrid;

namespace {

// How far `x` lies outside of [low, low + 1].
double outside(double x, int low) {
  return std::max({low - x, x - (low + 1), 0.0});
}

// The cells whose side [i, i + 1] comes as near as `reach` to `x`, cut to [0, size).
struct Range {
  Range(double x, double reach, int size)
      : first(static_cast<int>(std::clamp(std::floor(x - reach), 0.0, size * 1.0))),
        end(static_cast<int>(std::clamp(std::floor(x + reach) + 1.0, 0.0, size * 1.0))) {}
  int first;
  int end;
};

}  // namespace

double obstacleDistance(const OccupancyGrid& map, int occupied_min, const Eigen::Vector2d& position,
                        double reach) {
  const double resolution = map.geometry().resolution();
  const Eigen::Vector2d at = map.geometry().gridFromWorld(position);
  const Range columns(at.x(), reach / resolution, map.width());
  const Range rows(at.y(), reach / resolution, map.height());
  double nearest = reach / resolution;
  for (int row = rows.first; row < rows.end; ++row)
    for (int column = columns.first; column < columns.end; ++column)
      if (map[Cell{column, row}] >= occupied_min)
        nearest = std::min(nearest, std::hypot(outside(at.x(), column), outside(at.y(), row)));
  return nearest * resolution;
}

}  // namespace grid_path_planner::simulation
