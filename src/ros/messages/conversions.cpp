#include "grid_path_planner/ros/conversions.h"

#include <cmath>
#include <string>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/messages/pose_reading.h"

namespace grid_path_planner::nodes {

using base::InputError;
using path::Path;
using path::Pose;

double yawOf(const geometry_msgs::Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z);
}

Pose poseFromMessage(const geometry_msgs::Pose& message) {
  const Pose pose = readPose(message, ZeroHeading::REFUSED).pose;
  checkCoordinates(pose.position);
  return pose;
}

geometry_msgs::Pose poseToMessage(const Pose& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.position.x();
  message.position.y = pose.position.y();
  message.position.z = pose.position.z();
  message.orientation.z = std::sin(pose.yaw / 2.0);
  message.orientation.w = std::cos(pose.yaw / 2.0);
  return message;
}

Path pathFromMessage(const nav_msgs::Path& message) {
  Path path;
  path.frame_id = frameName(message.header.frame_id);
  for (const auto& stamped : message.poses) {
    try {
      path.poses.push_back(poseFromMessage(stamped.pose));
    } catch (const InputError& error) {
      throw InputError("pose " + std::to_string(path.poses.size() + 1) +
                       " of the path: " + error.what());
    }
  }
  return path;
}

nav_msgs::Path pathToMessage(const Path& path, const ros::Time& stamp) {
  nav_msgs::Path message;
  message.header.frame_id = path.frame_id;
  message.header.stamp = stamp;
  message.poses.reserve(path.poses.size());
  for (const Pose& pose : path.poses) {
    message.poses.emplace_back();
    message.poses.back().header = message.header;
    message.poses.back().pose = poseToMessage(pose);
  }
  return message;
}

}  // namespace grid_path_planner::nodes
