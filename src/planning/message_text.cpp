#include "planning/message_text.h"

#include <iomanip>
#include <sstream>

namespace grid_path_planner::planning {

std::string positionText(const Eigen::Vector2d& position) {
  std::ostringstream out;
  out << std::setprecision(6) << '(' << position.x() << ", " << position.y() << ')';
  return out.str();
}

std::string metresText(double length) {
  std::ostringstream out;
  out << std::setprecision(4) << length << " m";
  return out.str();
}

}  // namespace grid_path_planner::planning
