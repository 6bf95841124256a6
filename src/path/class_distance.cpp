// distanceToClass() of metrics.h.
#include <algorithm>
#include <cmath>
#include <cstring>

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

// The first column from `column` on whose cell is `wanted`; `end` where none is.
int next(const Occupancy* row, Occupancy wanted, int column, int end) {
  if (column >= end) return end;
  const void* found =
      std::memchr(row + column, static_cast<int>(wanted), static_cast<std::size_t>(end - column));
  return found == nullptr ? end : static_cast<int>(static_cast<const Occupancy*>(found) - row);
}

}  // namespace

double distanceToClass(const Grid<Occupancy>& classes, Occupancy wanted,
                       const Eigen::Vector2d& from, const Eigen::Vector2d& to, double limit,
                       double inset) {
  const Segment segment{classes.geometry().gridFromWorld(from),
                        classes.geometry().gridFromWorld(to)};
  const double resolution = classes.geometry().resolution();
  const double reach = limit / resolution + 1e-9;
  const Eigen::Vector2d low = segment.from.cwiseMin(segment.to);
  const Eigen::Vector2d high = segment.from.cwiseMax(segment.to);
  const Eigen::Vector2d rim(inset, inset);
  double least = limit;
  const Span rows(low.y() - reach, high.y() + reach, classes.height());
  for (int row = rows.first; row < rows.end; ++row) {
    // The part of the line that is near enough to the row.
    const auto near = clipped(segment, {{low.x(), row - reach}, {high.x(), row + 1.0 + reach}});
    if (!near) continue;
    const auto [left, right] = std::minmax(near->from.x(), near->to.x());
    const Span columns(left - reach, right + reach, classes.width());
    for (int column = next(classes.row(row), wanted, columns.first, columns.end);
         column < columns.end; column = next(classes.row(row), wanted, column + 1, columns.end)) {
      const Eigen::Vector2d corner(column, row);
      const Box square{corner + rim, corner + Eigen::Vector2d(1.0, 1.0) - rim};
      least = std::min(least, distanceBetween(segment, square) * resolution);
    }
  }
  return least;
}

}  // namespace grid_path_planner::path
