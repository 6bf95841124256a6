// What a simulated vehicle has run into.
//
//   contacts  std_msgs/UInt32, latched: how often the vehicle ran into something
//   contact   std_msgs/String, latched: what it ran into last, by its name in the world file
//
// Each contact is a warning in the log too. Nothing is said before `begin`, since a vehicle without
// surroundings touches nothing.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "grid_path_planner/simulation/vehicle.h"

namespace grid_path_planner::nodes {

class ContactPublisher {
 public:
  explicit ContactPublisher(ros::NodeHandle& nh);

  // There are surroundings, perhaps other ones: publishes the count as it is.
  void begin(const simulation::Vehicle& vehicle);
  // Publishes what has changed since the last call.
  void update(const simulation::Vehicle& vehicle);

 private:
  void publish(const simulation::Vehicle& vehicle);

  ros::Publisher count_publisher_;
  ros::Publisher name_publisher_;
  int published_ = -1;  // before `begin`
};

}  // namespace grid_path_planner::nodes
