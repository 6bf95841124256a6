#include "ros/simulation/contact_publisher.h"

#include <ros/console.h>
#include <std_msgs/String.h>
#include <std_msgs/UInt32.h>

#include "ros/guard/outgoing/latched_message.h"

namespace grid_path_planner::nodes {

using simulation::Vehicle;

ContactPublisher::ContactPublisher(ros::NodeHandle& nh)
    : count_publisher_(nh.advertise<std_msgs::UInt32>("contacts", 1, true)),
      name_publisher_(nh.advertise<std_msgs::String>("contact", 1, true)) {}

void ContactPublisher::update(const Vehicle& vehicle) {
  if (published_ >= 0 && published_ != vehicle.contacts()) start(vehicle);
}

void ContactPublisher::start(const Vehicle& vehicle) {
  const bool is_new = vehicle.contacts() > published_ && vehicle.contacts() > 0;
  published_ = vehicle.contacts();
  std_msgs::UInt32 count;
  count.data = static_cast<std::uint32_t>(published_);
  publishLatched(count_publisher_, count);
  if (!is_new) return;
  std_msgs::String name;
  name.data = vehicle.touched();
  publishLatched(name_publisher_, name);
  ROS_WARN_STREAM("The vehicle has run into " << name.data << ", contacts so far: " << count.data);
}

}  // namespace grid_path_planner::nodes
