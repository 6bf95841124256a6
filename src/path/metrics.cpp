#include "grid_path_planner/path/metrics.h"

#include <cmath>
#include <cstddef>
#include <iomanip>
#include <sstream>

namespace grid_path_planner::path {

double lengthOf(const Path& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.poses.size(); ++i)
    length += (path.poses[i].position - path.poses[i - 1].position).head<2>().norm();
  return length;
}

double turningOf(const Path& path) {
  double turning = 0.0;
  Eigen::Vector2d before = Eigen::Vector2d::Zero();
  for (std::size_t i = 1; i < path.poses.size(); ++i) {
    const Eigen::Vector2d now = (path.poses[i].position - path.poses[i - 1].position).head<2>();
    if (now.isZero(0.0)) continue;
    const double cross = before.x() * now.y() - before.y() * now.x();
    if (!before.isZero(0.0)) turning += std::abs(std::atan2(cross, before.dot(now)));
    before = now;
  }
  return turning;
}

std::string measuresText(double clearance, double turning) {
  std::ostringstream text;
  text << std::setprecision(3);
  if (std::isfinite(clearance)) text << "clearance " << clearance << " m, ";
  text << "turning " << turning << " rad";
  return text.str();
}

}  // namespace grid_path_planner::path
