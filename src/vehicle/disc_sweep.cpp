#include "vehicle/disc_sweep.h"

#include <algorithm>

#include "grid/segment.h"

namespace grid_path_planner::vehicle {

using grid::Cell, grid::CellSpan, grid::distanceBetween, grid::forEachRowInReach,
    grid::GridGeometry, grid::Segment;

namespace {

// Calls visit(cell, distance) (in cells) for obstacles within `reach` of the segment, and perhaps some beyond.
template <class Visit>
void forEachObstacle(const GridGeometry& geometry, const FootprintObstacles& obstacles,
                     const Segment& segment, double reach, Visit&& visit) {
  const auto visitRow = [&](int row, const CellSpan& columns) {
    for (int column = columns.first; column < columns.end; ++column) {
      column = obstacles.first({row, column, columns.end});
      if (column >= columns.end) return;
      const Eigen::Vector2d corner(column, row);
      visit(Cell{column, row},
            distanceBetween(segment, {corner, corner + Eigen::Vector2d::Ones()}));
    }
  };
  forEachRowInReach(segment, reach, geometry.width(), geometry.height(), visitRow);
}

// How far the segment (in cells) is from what lies outside the map; 0 where it leaves it.
double distanceToOutside(const GridGeometry& geometry, const Segment& segment) {
  const Eigen::Vector2d low = segment.from.cwiseMin(segment.to);
  const Eigen::Vector2d high = segment.from.cwiseMax(segment.to);
  const Eigen::Vector2d size(geometry.width(), geometry.height());
  return std::max(0.0, std::min(low.minCoeff(), (size - high).minCoeff()));
}

Cell cellAround(const Eigen::Vector2d& cells) {
  return {static_cast<int>(std::floor(cells.x())), static_cast<int>(std::floor(cells.y()))};
}

}  // namespace

double clearanceAt(const GridGeometry& geometry, const FootprintObstacles& obstacles,
                   const Eigen::Vector2d& position, double reach) {
  const Eigen::Vector2d at = geometry.gridFromWorld(position);
  const double resolution = geometry.resolution();
  double least = reach / resolution;
  if (obstacles.outside) least = std::min(least, distanceToOutside(geometry, {at, at}));
  forEachObstacle(geometry, obstacles, {at, at}, least,
                  [&](Cell, double distance) { least = std::min(least, distance); });
  return least * resolution;
}

std::optional<Cell> nearLine(const GridGeometry& geometry, const FootprintObstacles& obstacles,
                             const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                             double radius) {
  const Segment segment{geometry.gridFromWorld(from), geometry.gridFromWorld(to)};
  const double reach = radius / geometry.resolution();
  std::optional<Cell> nearest;
  double least = reach;
  forEachObstacle(geometry, obstacles, segment, reach, [&](Cell cell, double distance) {
    if (distance >= least) return;
    least = distance;
    nearest = cell;
  });
  if (!nearest && obstacles.outside && distanceToOutside(geometry, segment) < reach)
    nearest = cellAround(segment.to);
  return nearest;
}

}  // namespace grid_path_planner::vehicle
