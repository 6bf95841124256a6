// Whether the path ahead is free in a map.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::following {

// The first cell along the polyline `ahead` (map frame, metres; the z does not count) of at least
// `occupied_min` that the polyline meets, or comes nearer to than `radius` metres; none where all
// is free. "First" by pieces of the polyline of at most ten cells. Grazing a cell's edge or corner
// meets nothing; unknown cells and what lies outside the map are free.
std::optional<grid::Cell> firstOccupied(const grid::OccupancyGrid& map, int occupied_min,
                                        const std::vector<Eigen::Vector3d>& ahead, double radius);

}  // namespace grid_path_planner::following
