// distanceToClass() of metrics.h.
#include <algorithm>
#include <cmath>

#include "grid_path_planner/path/metrics.h"
#include "path/segment.h"

namespace grid_path_planner::path {

using grid::Cell;
using grid::Grid;
using grid::Occupancy;

namespace {

// Rows or columns of a map in reach of an interval.
struct Span {
  Span(double low, double high, int count)
      : first(clamped(std::floor(low), count)), end(clamped(std::floor(high) + 1.0, count)) {}

  static int clamped(double value, int count) {
    return static_cast<int>(std::min(std::max(value, 0.0), double(count)));
  }

  int first;
  int end;
};

}  // namespace

double distanceToClass(const Grid<Occupancy>& classes, Occupancy wanted,
                       const Eigen::Vector2d& from, const Eigen::Vector2d& to, double limit,
                       double inset) {
  const Segment segment{classes.geometry().gridFromWorld(from),
                        classes.geometry().gridFromWorld(to)};
  const double reach = limit / classes.geometry().resolution() + 1e-9;
  const Eigen::Vector2d low = segment.from.cwiseMin(segment.to);
  const Eigen::Vector2d high = segment.from.cwiseMax(segment.to);
  const Eigen::Vector2d rim(inset, inset);
  double least = limit / classes.geometry().resolution();
  const Span rows(low.y() - reach, high.y() + reach, classes.height());
  for (int row = rows.first; row < rows.end; ++row) {
    // The part of the line that is near enough to the row.
    const auto near = clipped(segment, {{low.x(), row - reach}, {high.x(), row + 1.0 + reach}});
    if (!near) continue;
    const auto [left, right] = std::minmax(near->from.x(), near->to.x());
    const Span columns(left - reach, right + reach, classes.width());
    for (int column = columns.first; column < columns.end; ++column) {
      if (classes.row(row)[column] != wanted) continue;
      const Eigen::Vector2d corner(column, row);
      const Box square{corner + rim, corner + Eigen::Vector2d(1.0, 1.0) - rim};
      least = std::min(least, distanceBetween(segment, square));
    }
  }
  return least * classes.geometry().resolution();
}

}  // namespace grid_path_planner::path
