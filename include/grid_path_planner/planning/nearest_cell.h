// The cell nearest a point, among those that may be used.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "grid_path_planner/grid/grid_geometry.h"

namespace grid_path_planner::planning {

struct NearestCell {
  grid::Cell cell;
  double distance = 0.0;  // m, from the point to the cell's centre
};

// The cell whose centre is nearest `point` (metres), at most `radius` metres away, among those of
// which `usable(cell)` holds; of equally near ones the one with the lowest index.
template <class Usable>
std::optional<NearestCell> nearestCell(const grid::GridGeometry& geometry,
                                       const Eigen::Vector2d& point, double radius,
                                       Usable&& usable) {
  const Eigen::Vector2d middle = geometry.gridFromWorld(point);
  const double reach = radius / geometry.resolution() + 1.0;
  const auto clamped = [](double value, int side) {
    return static_cast<int>(std::floor(std::min(std::max(value, 0.0), side - 1.0)));
  };
  const grid::Cell low{clamped(middle.x() - reach, geometry.width()),
                       clamped(middle.y() - reach, geometry.height())};
  const grid::Cell high{clamped(middle.x() + reach, geometry.width()),
                        clamped(middle.y() + reach, geometry.height())};
  const double slack = 1e-9 * geometry.resolution();  // distances that differ by rounding are equal
  std::optional<NearestCell> nearest;
  for (int row = low.row; row <= high.row; ++row)
    for (int column = low.column; column <= high.column; ++column) {
      const grid::Cell cell{column, row};
      const double distance = (geometry.centre(cell) - point).norm();
      if (distance > radius + slack || (nearest && distance > nearest->distance - slack)) continue;
      if (usable(cell)) nearest = NearestCell{cell, distance};
    }
  return nearest;
}

}  // namespace grid_path_planner::planning
