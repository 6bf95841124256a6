// A vehicle's velocity as a message, and back.
//
//   const geometry_msgs::Twist message = velocityToMessage({0.5, 0.0, 0.0, 0.1});
#pragma once

#include <geometry_msgs/Twist.h>

#include "grid_path_planner/base/body_velocity.h"

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

}  // namespace grid_path_planner::nodes
