// A vehicle's velocity as a message, and back.
//
//   const geometry_msgs::Twist message = velocityToMessage({0.5, 0.0, 0.0, 0.1});
//   if (const auto velocity = measuredVelocity(odometry, ros::Time::now(), 0.5)) use(*velocity);
#pragma once

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>

#include <cmath>
#include <optional>

#include "grid_path_planner/base/body_velocity.h"
#include "ros/guard/clock.h"

namespace grid_path_planner::nodes {

inline geometry_msgs::Twist velocityToMessage(const base::BodyVelocity& velocity) {
  geometry_msgs::Twist message;
  message.linear.x = velocity.surge;
  message.linear.y = velocity.sway;
  message.linear.z = velocity.heave;
  message.angular.z = velocity.yaw_rate;
  return message;
}

// Rates about x and y are passed over. Numbers are taken as they are, NaN too.
inline base::BodyVelocity velocityFromMessage(const geometry_msgs::Twist& message) {
  return {message.linear.x, message.linear.y, message.linear.z, message.angular.z};
}

// None where it is stamped more than `most` seconds from now, or is not finite.
inline std::optional<base::BodyVelocity> measuredVelocity(const nav_msgs::Odometry& odometry,
                                                          const ros::Time& now, double most) {
  if (std::abs(secondsBetween(odometry.header.stamp, now)) >= most) return std::nullopt;
  const base::BodyVelocity measured = velocityFromMessage(odometry.twist.twist);
  return measured.isFinite() ? std::make_optional(measured) : std::nullopt;
}

}  // namespace grid_path_planner::nodes
