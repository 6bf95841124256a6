// Pictures of a simulated world at one depth, or from one depth to another.
#pragma once

#include <initializer_list>

#include "grid_path_planner/grid/occupancy.h"
#include "grid_path_planner/simulation/world.h"

namespace grid_path_planner::test {

// The cells of `geometry` (map frame) over whose centre a ball of `radius` metres would cut a solid
// surface at one of the heights are 100, the others 0.
inline grid::OccupancyGrid occupiedAt(const simulation::World& world,
                                      const grid::GridGeometry& geometry,
                                      std::initializer_list<double> heights, double radius) {
  grid::OccupancyGrid grid(geometry);
  for (int row = 0; row < geometry.height(); ++row)
    for (int column = 0; column < geometry.width(); ++column) {
      const Eigen::Vector2d centre = geometry.centre({column, row});
      for (const double z : heights)
        if (world.nearest({centre.x(), centre.y(), z}, radius)) grid[grid::Cell{column, row}] = 100;
    }
  return grid;
}

}  // namespace grid_path_planner::test
