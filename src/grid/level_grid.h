// The grid without a yaw over a map whose origin has one, and which of the map's cells lie on which of its.
//
//   const LevelGrid level(GridGeometry(4, 3, 1.0, {0.0, 0.0, 0.3}));
//   int cells = 0;
//   const bool covered = level.sources({1, 2}, [&](Cell source) { ++cells; });
//
// Cells keep their size, and the grid is as small as holds the whole map. Guaranteed: `sources` visits a cell if
// and only if the interiors of the two squares share more than a strip of 1e-6 cells, so that quarter turns are
// exact. An obstacle thereby grows by at most the diagonal of a cell.
#pragma once

#include <cmath>

#include "grid_path_planner/grid/grid_geometry.h"

namespace grid_path_planner::grid {

// More than 1e-9 rad.
bool hasYaw(const GridGeometry& geometry);

class LevelGrid {
 public:
  // Throws InputError where the grid has more than ten times the map's cells: of a long thin map.
  explicit LevelGrid(const GridGeometry& from);

  const GridGeometry& geometry() const { return level_; }

  // Calls visit(Cell) for each cell of the map that lies on a cell of the grid, row by row; returns whether the map
  // holds all of it.
  template <class Visit>
  bool sources(Cell target, Visit visit) const {
    const Eigen::Vector2d centre = from_.gridFromWorld(level_.centre(target));
    bool covered = true;
    const auto first = [&](double c) { return static_cast<int>(std::floor(c - 0.5 - reach_)) + 1; };
    const auto last = [&](double c) { return static_cast<int>(std::ceil(c - 0.5 + reach_)) - 1; };
    for (int row = first(centre.y()); row <= last(centre.y()); ++row)
      for (int column = first(centre.x()); column <= last(centre.x()); ++column) {
        if (!shares(centre, {column, row})) continue;
        if (from_.contains({column, row}))
          visit(Cell{column, row});
        else
          covered = false;
      }
    return covered;
  }

 private:
  // Whether no side of either square separates them.
  bool shares(const Eigen::Vector2d& centre, Cell cell) const {
    const double x = centre.x() - cell.column - 0.5;
    const double y = centre.y() - cell.row - 0.5;
    return std::abs(x) < reach_ && std::abs(y) < reach_ && std::abs(cos_ * x - sin_ * y) < reach_ &&
           std::abs(sin_ * x + cos_ * y) < reach_;
  }

  GridGeometry from_, level_;
  double cos_, sin_;  // of the map's yaw
  double reach_;      // cells; of centres, along a side of either
};

}  // namespace grid_path_planner::grid
