// distanceToClass() of metrics.h.
#include <algorithm>
#include <cstring>

#include "grid/segment.h"
#include "grid_path_planner/path/metrics.h"

namespace grid_path_planner::path {

using grid::Box;
using grid::Cell;
using grid::CellSpan;
using grid::distanceBetween;
using grid::forEachRowInReach;
using grid::Grid;
using grid::Occupancy;
using grid::Segment;

namespace {

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
  const Eigen::Vector2d rim(inset, inset);
  double least = limit;
  const auto lowerInRow = [&](int row, const CellSpan& columns) {
    for (int column = next(classes.row(row), wanted, columns.first, columns.end);
         column < columns.end; column = next(classes.row(row), wanted, column + 1, columns.end)) {
      const Eigen::Vector2d corner(column, row);
      const Box square{corner + rim, corner + Eigen::Vector2d(1.0, 1.0) - rim};
      least = std::min(least, distanceBetween(segment, square) * resolution);
    }
  };
  forEachRowInReach(segment, reach, classes.width(), classes.height(), lowerInRow);
  return least;
}

}  // namespace grid_path_planner::path
