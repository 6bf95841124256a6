#include "ros/simulation/vehicle_publisher.h"

#include <nav_msgs/Odometry.h>

#include <cmath>
#include <utility>

namespace grid_path_planner::nodes {

using simulation::BodyTwist;
using simulation::VehicleState;

namespace {

// Turned by yaw, then pitch, then roll; of a level vehicle x and y are 0, without rounding.
geometry_msgs::Quaternion orientationOf(const VehicleState& state) {
  const double sy = std::sin(0.5 * state.yaw), cy = std::cos(0.5 * state.yaw);
  const double sp = std::sin(0.5 * state.pitch), cp = std::cos(0.5 * state.pitch);
  const double sr = std::sin(0.5 * state.roll), cr = std::cos(0.5 * state.roll);
  geometry_msgs::Quaternion q;
  q.x = cy * cp * sr - sy * sp * cr;
  q.y = cy * sp * cr + sy * cp * sr;
  q.z = sy * cp * cr - cy * sp * sr;
  q.w = cy * cp * cr + sy * sp * sr;
  return q;
}

nav_msgs::Odometry odometryOf(const VehicleState& state, const std::string& frame,
                              const std::string& base, const ros::Time& stamp) {
  nav_msgs::Odometry message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.child_frame_id = base;
  message.pose.pose.position.x = state.position.x();
  message.pose.pose.position.y = state.position.y();
  message.pose.pose.position.z = state.position.z();
  message.pose.pose.orientation = orientationOf(state);
  const BodyTwist twist = bodyTwist(state);
  message.twist.twist.linear.x = twist.linear.x();
  message.twist.twist.linear.y = twist.linear.y();
  message.twist.twist.linear.z = twist.linear.z();
  message.twist.twist.angular.x = twist.angular.x();
  message.twist.twist.angular.y = twist.angular.y();
  message.twist.twist.angular.z = twist.angular.z();
  return message;
}

geometry_msgs::TransformStamped transformOf(const nav_msgs::Odometry& odometry) {
  geometry_msgs::TransformStamped transform;
  transform.header = odometry.header;
  transform.child_frame_id = odometry.child_frame_id;
  transform.transform.translation.x = odometry.pose.pose.position.x;
  transform.transform.translation.y = odometry.pose.pose.position.y;
  transform.transform.translation.z = odometry.pose.pose.position.z;
  transform.transform.rotation = odometry.pose.pose.orientation;
  return transform;
}

geometry_msgs::TransformStamped identity(const std::string& frame, const std::string& child) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = frame;
  transform.child_frame_id = child;
  transform.transform.rotation.w = 1.0;
  return transform;
}

}  // namespace

VehiclePublisher::VehiclePublisher(ros::NodeHandle& nh)
    : truth_publisher_(nh.advertise<nav_msgs::Odometry>("ground_truth", 10)),
      odometry_publisher_(nh.advertise<nav_msgs::Odometry>("odom", 10)) {}

void VehiclePublisher::setFixed(std::vector<geometry_msgs::TransformStamped> transforms) {
  fixed_ = std::move(transforms);
}

void VehiclePublisher::publish(const VehicleState& truth, const VehicleState& measured,
                               const ros::Time& stamp, const VehicleFrameNames& frames) {
  truth_publisher_.publish(odometryOf(truth, frames.map, frames.base, stamp));
  const nav_msgs::Odometry odometry = odometryOf(measured, frames.odometry, frames.base, stamp);
  odometry_publisher_.publish(odometry);
  std::vector<geometry_msgs::TransformStamped> transforms = fixed_;
  if (frames.map_to_odometry) transforms.push_back(identity(frames.map, frames.odometry));
  if (frames.odometry_to_base) transforms.push_back(transformOf(odometry));
  for (auto& transform : transforms) transform.header.stamp = stamp;
  broadcaster_.sendTransform(transforms);
}

}  // namespace grid_path_planner::nodes
