// Poses and paths as messages, and back.
//
//   const Pose goal = poseFromMessage(message.pose);                    // throws InputError
//   publisher.publish(pathToMessage(path, ros::Time::now()));
//
// A pose of this package is a position and a yaw; a message that says more (roll, pitch, beyond what is measured or typed
// badly) or less (a quaternion of zeros) is refused rather than read as something else.
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Quaternion.h>
#include <nav_msgs/Path.h>
#include <ros/time.h>

#include "grid_path_planner/path/path.h"

namespace grid_path_planner::nodes {

// The angle about z in -pi..pi. Roll and pitch are passed over: for the pose of a vehicle, which
// tilts. Precondition: not all components are 0.
double yawOf(const geometry_msgs::Quaternion& quaternion);

// Throws InputError for a number that is not finite, a coordinate beyond 1e6 m, a quaternion that is zero, whose length is
// off 1 by more than 0.1, or that tilts by more than 2.56 degrees.
path::Pose poseFromMessage(const geometry_msgs::Pose& message);
geometry_msgs::Pose poseToMessage(const path::Pose& pose);

// The frame's leading slash is dropped. Throws InputError naming the pose (from 1) for what
// poseFromMessage refuses.
path::Path pathFromMessage(const nav_msgs::Path& message);
// Every pose carries the path's frame and stamp.
nav_msgs::Path pathToMessage(const path::Path& path, const ros::Time& stamp);

}  // namespace grid_path_planner::nodes
