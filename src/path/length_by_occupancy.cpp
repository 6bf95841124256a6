// lengthsByClass() of metrics.h.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "grid_path_planner/path/metrics.h"

namespace grid_path_planner::path {

using grid::Cell, grid::Grid, grid::GridGeometry, grid::Occupancy, grid::OccupancyGrid,
    grid::OccupancyThresholds;

namespace {

// Adds the shares of the segment's length at which one coordinate passes from cell to cell.
void addCrossings(double from, double to, double side, std::vector<double>& shares) {
  const double low = std::max(0.0, std::ceil(std::min(from, to)));
  const double high = std::min(side, std::floor(std::max(from, to)));
  for (double line = low; line <= high; line += 1.0)
    if (from != to) shares.push_back(std::clamp((line - from) / (to - from), 0.0, 1.0));
}

// The cell that holds this point of the grid; none outside the map.
std::optional<Cell> cellAt(const Eigen::Vector2d& point, const GridGeometry& geometry) {
  const bool inside = point.x() >= 0.0 && point.x() < geometry.width() && point.y() >= 0.0 &&
                      point.y() < geometry.height();
  if (!inside) return std::nullopt;
  return Cell{static_cast<int>(point.x()), static_cast<int>(point.y())};
}

// The shares of the segment's length at which it passes from cell to cell, its ends included, in
// order.
void findCrossings(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                   const GridGeometry& geometry, std::vector<double>& shares) {
  shares = {0.0, 1.0};
  addCrossings(from.x(), to.x(), geometry.width(), shares);
  addCrossings(from.y(), to.y(), geometry.height(), shares);
  std::sort(shares.begin(), shares.end());
}

double* lengthFor(ClassLengths& lengths, Occupancy occupancy) {
  switch (occupancy) {
    case Occupancy::FREE:
      return &lengths.free_m;
    case Occupancy::UNKNOWN:
      return &lengths.unknown_m;
    case Occupancy::OCCUPIED:
      break;
  }
  return &lengths.occupied_m;
}

// The poses in the map's grid. Asks for the cells' memory, which is in no cache along a path across a
// large map: one after the other they took longer than all else.
template <class Value>
std::vector<Eigen::Vector2d> pointsIn(const Grid<Value>& cells, const Path& path) {
  const GridGeometry& geometry = cells.geometry();
  std::vector<Eigen::Vector2d> points;
  points.reserve(path.poses.size());
  for (const Pose& pose : path.poses) {
    points.push_back(geometry.gridFromWorld(pose.position.head<2>()));
    if (const auto cell = cellAt(points.back(), geometry)) __builtin_prefetch(&cells[*cell]);
  }
  return points;
}

// class_of(value): the class of a cell with this value.
template <class Value, class ClassOf>
ClassLengths lengthsIn(const Grid<Value>& cells, const Path& path, ClassOf&& class_of) {
  const GridGeometry& geometry = cells.geometry();
  const std::vector<Eigen::Vector2d> points = pointsIn(cells, path);
  ClassLengths lengths;
  std::vector<double> shares;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d &from = points[i - 1], &to = points[i];
    findCrossings(from, to, geometry, shares);
    const double metres = (to - from).norm() * geometry.resolution();
    for (std::size_t piece = 1; piece < shares.size(); ++piece) {
      const double share = shares[piece] - shares[piece - 1];
      if (share <= 0.0) continue;
      const Eigen::Vector2d middle = from + 0.5 * (shares[piece - 1] + shares[piece]) * (to - from);
      if (const auto cell = cellAt(middle, geometry))
        *lengthFor(lengths, class_of(cells[*cell])) += share * metres;
    }
  }
  return lengths;
}

}  // namespace

ClassLengths lengthsByClass(const Path& path, const OccupancyGrid& map,
                            const OccupancyThresholds& thresholds) {
  return lengthsIn(map, path, [&](auto value) { return thresholds.classify(value); });
}

ClassLengths lengthsByClass(const Path& path, const Grid<Occupancy>& classes) {
  return lengthsIn(classes, path, [](Occupancy occupancy) { return occupancy; });
}

}  // namespace grid_path_planner::path
