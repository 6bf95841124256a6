// The contacts of a simulated vehicle as topics.
//
//   contacts  std_msgs/UInt32, latched: how often the vehicle ran into something
//   contact   std_msgs/String, latched: what it ran into last, by its name in the world file
//
// Each contact is a warning in the log too. Nothing is published before `start`, since a vehicle
// without obstacles has no contacts.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "grid_path_planner/simulation/vehicle.h"

namespace grid_path_planner::nodes {

class ContactPublisher {
 public:
  explicit ContactPublisher(ros::NodeHandle& nh);

  // After the obstacles were set or replaced: publishes the present contacts.
  void start(const simulation::Vehicle& vehicle);
  // Publishes contacts since the last call.
  void update(const simulation::Vehicle& vehicle);

 private:
  ros::Publisher count_publisher_;
  ros::Publisher name_publisher_;
  int published_ = -1;  // before `start`
};

}  // namespace grid_path_planner::nodes
