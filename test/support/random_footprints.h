// Maps with doors and vehicles that are not round, for laws on footprints.
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::test {

// 60x60 cells of 0.1 m: rooms of 2 m with doors of 0.4 to 0.9 m, and some clutter. `yaw`: of the origin.
grid::OccupancyGrid randomRooms(std::mt19937& random, double yaw);

// Corners in metres about the origin, which need not be the middle; half of them rectangles.
std::vector<Eigen::Vector2d> randomVehicle(std::mt19937& random);

}  // namespace grid_path_planner::test
