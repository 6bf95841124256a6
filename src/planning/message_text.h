// Numbers and notes as the messages of a plan give them.
#pragma once

#include <Eigen/Core>
#include <string>

#include "grid_path_planner/path/metrics.h"

namespace grid_path_planner::planning {

// "(1.5, 2)", six digits.
std::string positionText(const Eigen::Vector2d& position);

// "12.34 m", four digits.
std::string metresText(double length);

// "heading -90 deg", whole degrees.
std::string headingText(double yaw);

// "no path leads from (1.5, 2) to (3, 4) or within 0.5 m of it".
std::string unreachableText(const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                            double tolerance);

// "3.2 m of it through unknown cells"; "" where there are none.
std::string unknownNote(const path::ClassLengths& lengths);

// Adds a note to a message, after "; ". An empty one adds nothing.
void addNote(std::string& message, const std::string& note);

}  // namespace grid_path_planner::planning
