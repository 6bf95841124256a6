// Whether a disc meets obstacles of a map while it moves on a line, and how far from them it is.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "grid_path_planner/grid/grid_geometry.h"
#include "vehicle/sweep.h"

namespace grid_path_planner::vehicle {

// Metres from `position` to the nearest obstacle, at most `reach`.
double clearanceAt(const grid::GridGeometry& geometry, const FootprintObstacles& obstacles,
                   const Eigen::Vector2d& position, double reach);

// A cell that is nearer than `radius` (m) to the line from `from` to `to`; perhaps beside the map.
std::optional<grid::Cell> nearLine(const grid::GridGeometry& geometry,
                                   const FootprintObstacles& obstacles, const Eigen::Vector2d& from,
                                   const Eigen::Vector2d& to, double radius);

}  // namespace grid_path_planner::vehicle
