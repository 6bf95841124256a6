#include "ros/simulation/transform_message.h"

namespace grid_path_planner::nodes {

geometry_msgs::TransformStamped transformOf(const std::string& frame, const std::string& child,
                                            const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.rotation());
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = frame;
  transform.child_frame_id = child;
  transform.transform.translation.x = pose.translation().x();
  transform.transform.translation.y = pose.translation().y();
  transform.transform.translation.z = pose.translation().z();
  transform.transform.rotation.x = q.x();
  transform.transform.rotation.y = q.y();
  transform.transform.rotation.z = q.z();
  transform.transform.rotation.w = q.w();
  return transform;
}

}  // namespace grid_path_planner::nodes
