// The node `simulator`: a vehicle that follows cmd_vel, for trying the other nodes without one.
//
//   subscribes  cmd_vel        geometry_msgs/Twist in base_link; zeroed cmd_vel_timeout after the
//   last
//               projected_map  nav_msgs/OccupancyGrid; its occupied cells hold the vehicle up
//   publishes   odom           nav_msgs/Odometry
//               tf             odom -> base_link, map -> odom (the identity)
//               /clock         at real_time_factor; only with publish_clock
//               contacts       std_msgs/UInt32, latched; how often the vehicle ran into an
//               obstacle,
//                              from the first map on
//
// Guaranteed: the steps follow the wall clock, never the clock that they make. Where the machine is
// too slow, simulated time goes slower; no step is left out.
#pragma once

#include <geometry_msgs/Twist.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/steady_timer.h>
#include <ros/subscriber.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>

#include "grid_path_planner/ros/simulator_options.h"
#include "grid_path_planner/simulation/vehicle.h"

namespace grid_path_planner {

class SimulatorConfig;
template <class Config, class Options>
class Reconfigurable;

class SimulatorNode {
 public:
  // Throws InputError for parameters that cannot be used. All callbacks are served by the queue of
  // `nh`, which must be one thread's.
  SimulatorNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh);
  ~SimulatorNode();

 private:
  void use(const SimulatorOptions& options);
  void startTimer();
  void onCommand(const geometry_msgs::Twist& message);
  void onMap(const nav_msgs::OccupancyGrid& message);
  void onTimer(const ros::SteadyTimerEvent& event);
  void publishState();
  void publishContacts();
  ros::Time now() const;

  ros::NodeHandle nh_;
  SimulatorOptions options_;
  std::unique_ptr<Vehicle> vehicle_;
  double owed_ = 0.0;  // s of simulated time that are due
  ros::SteadyTime last_tick_;
  ros::Time last_stamp_;
  int published_contacts_ = -1;

  ros::Publisher odometry_publisher_;
  ros::Publisher clock_publisher_;
  ros::Publisher contacts_publisher_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Subscriber command_subscriber_;
  ros::Subscriber map_subscriber_;
  ros::SteadyTimer timer_;
  std::unique_ptr<Reconfigurable<SimulatorConfig, SimulatorOptions>> reconfigurable_;
};

}  // namespace grid_path_planner
