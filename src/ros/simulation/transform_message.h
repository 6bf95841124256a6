// Transforms that hold on the vehicle, as messages.
#pragma once

#include <geometry_msgs/TransformStamped.h>

#include <Eigen/Geometry>
#include <string>

namespace grid_path_planner::nodes {

// `child` in `frame`, without a stamp.
geometry_msgs::TransformStamped transformOf(const std::string& frame, const std::string& child,
                                            const Eigen::Isometry3d& pose);

}  // namespace grid_path_planner::nodes
