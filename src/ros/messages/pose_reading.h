// The rule for poses that other programs publish, one for all nodes.
//
//   const PoseReading read = readPose(message, ZeroHeading::REFUSED);
//   if (read.told) ROS_WARN_STREAM("A pose: " << read.told);
//   checkCoordinates(placed(read.pose).position);
//
// Taken, and told: an orientation that tilts by up to 2.56 degrees, as move_base takes it, and a quaternion whose length is
// off 1 by up to 0.1. Beyond, and what is not finite, is refused. Coordinates may be any: how far a place is from the map's
// origin is known once it is in the map, and utm's are millions of metres.
#pragma once

#include <geometry_msgs/Pose.h>

#include "grid_path_planner/path/path.h"
#include "ros/messages/zero_heading.h"

namespace grid_path_planner::nodes {

struct PoseReading {
  path::Pose pose;  // its yaw is NaN where the orientation is of zeros and any heading will do
  const char* told = nullptr;  // what was taken for something else, if anything
};

// Throws InputError.
PoseReading readPose(const geometry_msgs::Pose& message, ZeroHeading zero_heading);

// Throws InputError for a coordinate that is not finite or beyond 1e6 m.
void checkCoordinates(const Eigen::Vector3d& position);

}  // namespace grid_path_planner::nodes
