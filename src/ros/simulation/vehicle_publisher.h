// The pose of a simulated vehicle as topics and tf: the true pose, and the pose by odometry.
//
//   VehiclePublisher publisher(nh);
//   publisher.publish(truth, measured, stamp, frames);
//
//   ground_truth  nav_msgs/Odometry in the frame of the map
//   odom          nav_msgs/Odometry in the frame of the odometry
//   tf            odometry -> vehicle as measured, and map -> odometry (the identity), where asked for
//
// Errors of the odometry are errors of tf from map to vehicle, as on a vehicle without a
// localisation. No transform is static: a listener that clears its buffer as time jumps back would
// not receive a static one again.
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_ros/transform_broadcaster.h>

#include <string>
#include <vector>

#include "grid_path_planner/simulation/vehicle.h"

namespace grid_path_planner::nodes {

struct VehicleFrameNames {
  std::string map = "map";
  std::string odometry = "odom";
  std::string base = "base_link";
  bool map_to_odometry = true;
  bool odometry_to_base = true;
};

class VehiclePublisher {
 public:
  explicit VehiclePublisher(ros::NodeHandle& nh);

  // Transforms that hold on the vehicle, such as to its sensors: sent with every pose.
  void setFixed(std::vector<geometry_msgs::TransformStamped> transforms);

  void publish(const simulation::VehicleState& truth, const simulation::VehicleState& measured,
               const ros::Time& stamp, const VehicleFrameNames& frames);

 private:
  ros::Publisher truth_publisher_;
  ros::Publisher odometry_publisher_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::vector<geometry_msgs::TransformStamped> fixed_;
};

}  // namespace grid_path_planner::nodes
