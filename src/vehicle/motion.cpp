#include "vehicle/motion.h"

#include <Eigen/Geometry>

namespace grid_path_planner::vehicle {

std::vector<Eigen::Vector2d> outlineAt(const Footprint& footprint, const Motion& motion,
                                       double share) {
  const double yaw = motion.yaw + share * motion.turn;
  const Eigen::Vector2d at = motion.from + share * (motion.to - motion.from);
  std::vector<Eigen::Vector2d> outline;
  for (const Eigen::Vector2d& corner : footprint.corners())
    outline.push_back(at + Eigen::Rotation2Dd(yaw) * corner);
  return outline;
}

}  // namespace grid_path_planner::vehicle
