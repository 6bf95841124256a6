// Numbers and notes as the messages of a plan give them.
#pragma once

#include <Eigen/Core>
#include <string>

#include "grid_path_planner/costmap/motion_model.h"

namespace grid_path_planner::planning {

// "(1.5, 2)", six digits.
std::string positionText(const Eigen::Vector2d& position);

// "12.34 m", four digits.
std::string metresText(double length);

// "it keeps only 0.2 m from unknown cells, as near as its ends are".
std::string loweredNote(const costmap::KeptDistances& asked, const costmap::KeptDistances& kept);

}  // namespace grid_path_planner::planning
