#include "following/speed_limit.h"

#include <algorithm>
#include <cmath>

#include "following/driven_route.h"
#include "following/polyline_cells.h"

namespace grid_path_planner::following {

using Eigen::Vector2d;
using grid::CellRect;
using grid::OccupancyGrid;

double speedLimitLookahead(const FollowerOptions& options) {
  return options.max_speed * options.max_speed / (2.0 * brakingDeceleration(options));
}

double allowedSpeed(const OccupancyGrid& limits, const FollowerOptions& options,
                    const std::vector<Eigen::Vector3d>& ahead) {
  double allowed = options.max_speed;
  double driven = 0.0;  // m, to the piece
  visitPieces(limits.geometry(), ahead, [&](const Vector2d& from, const Vector2d& to) {
    const double length = (to - from).norm() * limits.geometry().resolution();
    const CellRect cells = cellsBetween(limits.geometry(), from.cwiseMin(to).array() - kGraze,
                                        from.cwiseMax(to).array() + kGraze);
    for (int row = cells.row; row < cells.row + cells.height; ++row)
      for (int column = cells.column; column < cells.column + cells.width; ++column) {
        const int percent = limits.row(row)[column];
        if (percent < 1 || percent >= 100) continue;
        const auto entry = entryInto(from, to, {column, row}, -kGraze);
        if (!entry) continue;
        const double limit = options.max_speed * percent / 100.0;
        const double braking = 2.0 * brakingDeceleration(options) * (driven + *entry * length);
        allowed = std::min(allowed, std::sqrt(limit * limit + braking));
      }
    driven += length;
    return false;
  });
  return allowed;
}

}  // namespace grid_path_planner::following
