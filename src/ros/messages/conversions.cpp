#include "grid_path_planner/ros/conversions.h"

#include <cmath>
#include <string>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/waypoint_file.h"
#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::nodes {

using base::decimalText;
using base::InputError;
using path::kLargestCoordinate;
using path::Path;
using path::Pose;

namespace {

constexpr double kQuaternionSlack = 0.01;

void checkPosition(const geometry_msgs::Point& point) {
  const double coordinates[] = {point.x, point.y, point.z};
  for (const double coordinate : coordinates)
    if (!(std::abs(coordinate) <= kLargestCoordinate))  // NaN fails it
      throw InputError("a coordinate must be a finite number of metres within 1e6, got " +
                       decimalText(coordinate));
}

void checkLevel(const geometry_msgs::Quaternion& q) {
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(std::abs(length - 1.0) <= kQuaternionSlack))
    throw InputError(
        "an orientation must be a quaternion of length 1 (w: 1 alone looks along x), got length " +
        decimalText(length));
  // The angle between the pose's z axis and the frame's.
  const double tilt = 2.0 * std::asin(std::min(1.0, std::hypot(q.x, q.y) / length));
  if (tilt > kQuaternionSlack)
    throw InputError("an orientation must be level, got one tilted by " + std::to_string(tilt) +
                     " rad");
}

}  // namespace

double yawOf(const geometry_msgs::Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z);
}

Pose poseFromMessage(const geometry_msgs::Pose& message) {
  checkPosition(message.position);
  checkLevel(message.orientation);
  Pose pose;
  pose.position = {message.position.x, message.position.y, message.position.z};
  pose.yaw = yawOf(message.orientation);
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
