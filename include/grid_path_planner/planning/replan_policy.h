// Whether a vehicle goes on along the path it has: no ROS here.
//
// An old path is judged by what remains of it: the straight way from where the vehicle is to the
// nearest point of the path, and the path from there on. On the present map that must be legal, and
// to be kept beside a new path it must cost at most (1 + hysteresis) times as much. So replanning
// does not flip between two ways that are about as good, and never keeps a way that is blocked.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::planning {

using Polyline = std::vector<Eigen::Vector2d>;  // metres, map frame

// What remains of `path` for a vehicle at `position`; of two points equally near the later one.
Polyline remainingPath(const path::Path& path, const Eigen::Vector2d& position);

// Cost in cells of the original map x weight; none where a piece of `line` is not legal on `costs`.
std::optional<double> costOf(const Polyline& line, const costmap::CostGrid& costs);

// Whether what remains of `path` meets an obstacle. `position`: none: all of it remains.
bool pathBlocked(const path::Path& path, const std::optional<Eigen::Vector2d>& position,
                 const costmap::CostGrid& costs);

// Whether a vehicle at the start of `fresh` keeps `old`, which leads to the same pose. `costs` are
// those of the full-resolution map.
bool keepsPath(const path::Path& old, const path::Path& fresh, const costmap::CostGrid& costs,
               double hysteresis);

}  // namespace grid_path_planner::planning
