// Numbers as the messages of a plan give them.
#pragma once

#include <Eigen/Core>
#include <string>

namespace grid_path_planner::planning {

// "(1.5, 2)", six digits.
std::string positionText(const Eigen::Vector2d& position);

// "12.34 m", four digits.
std::string metresText(double length);

}  // namespace grid_path_planner::planning
