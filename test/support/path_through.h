// A level path through points, for tests of what paths are.
#pragma once

#include <vector>

#include "grid_path_planner/path/path.h"

namespace grid_path_planner::test {

// Every yaw is 0 but the last.
inline path::Path pathThrough(const std::vector<Eigen::Vector2d>& points, double goal_yaw = 0.0) {
  path::Path path;
  for (const Eigen::Vector2d& point : points) {
    path.poses.emplace_back();
    path.poses.back().position << point, 0.0;
  }
  if (!path.empty()) path.poses.back().yaw = goal_yaw;
  return path;
}

}  // namespace grid_path_planner::test
