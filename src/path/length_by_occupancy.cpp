// lengthsByClass() of metrics.h.
#include <algorithm>
#include <cmath>
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

// class_of(cell): the class of a cell of the map.
template <class ClassOf>
ClassLengths lengthsIn(const GridGeometry& geometry, const Path& path, ClassOf&& class_of) {
  ClassLengths lengths;
  std::vector<double> shares;
  for (std::size_t i = 1; i < path.poses.size(); ++i) {
    const Eigen::Vector2d from = geometry.gridFromWorld(path.poses[i - 1].position.head<2>());
    const Eigen::Vector2d to = geometry.gridFromWorld(path.poses[i].position.head<2>());
    findCrossings(from, to, geometry, shares);
    const double metres = (to - from).norm() * geometry.resolution();
    for (std::size_t piece = 1; piece < shares.size(); ++piece) {
      const double share = shares[piece] - shares[piece - 1];
      const Eigen::Vector2d middle = from + 0.5 * (shares[piece - 1] + shares[piece]) * (to - from);
      const Cell cell{static_cast<int>(std::floor(middle.x())),
                      static_cast<int>(std::floor(middle.y()))};
      if (share > 0.0 && geometry.contains(cell))
        *lengthFor(lengths, class_of(cell)) += share * metres;
    }
  }
  return lengths;
}

}  // namespace

ClassLengths lengthsByClass(const Path& path, const OccupancyGrid& map,
                            const OccupancyThresholds& thresholds) {
  return lengthsIn(map.geometry(), path, [&](Cell cell) { return thresholds.classify(map[cell]); });
}

ClassLengths lengthsByClass(const Path& path, const Grid<Occupancy>& classes) {
  return lengthsIn(classes.geometry(), path, [&](Cell cell) { return classes[cell]; });
}

}  // namespace grid_path_planner::path
