// Decides whether a vehicle keeps its path or takes a new one. No ROS here.
//
// An old path is judged by its remainder: the straight line from the vehicle to the nearest point
// of the path, and the path from there on. The remainder must be legal on the present map, and must
// cost at most (1 + hysteresis) times as much as a new path. So replanning does not alternate
// between two paths of about equal cost, and never keeps a path that is blocked.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::planning {

using Polyline = std::vector<Eigen::Vector2d>;  // metres, map frame

// The remainder of `path` for a vehicle at `position`; of two equally near points the later one
// counts.
Polyline remainingPath(const path::Path& path, const Eigen::Vector2d& position);

// Cost in cells of the original map x weight; none where a segment of `line` is not legal on
// `costs`. Where these keep distances a segment is legal if it keeps them, but for the first two,
// which may leave a nearer start; to unknown cells and to the border no more is asked than both
// ends have.
std::optional<double> costOf(const Polyline& line, const costmap::CostGrid& costs);

// Whether the remainder of `path` meets an obstacle. Without a `position` all of it remains.
bool pathBlocked(const path::Path& path, const std::optional<Eigen::Vector2d>& position,
                 const costmap::CostGrid& costs);

// Whether a vehicle at the start of `fresh` keeps `old`; false if they end at different poses.
// `costs` is the costmap at full resolution.
bool keepsPath(const path::Path& old, const path::Path& fresh, const costmap::CostGrid& costs,
               double hysteresis);

}  // namespace grid_path_planner::planning
