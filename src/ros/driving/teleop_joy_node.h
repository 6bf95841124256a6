// The node `teleop_joy`: a vehicle driven by joystick.
//
//   subscribes  joy      sensor_msgs/Joy; its driver must repeat (joy_node's ~autorepeat_rate)
//               stop     std_msgs/Bool; zeros while it is true
//   publishes   cmd_vel  geometry_msgs/Twist in base_link, while the deadman button is held
//               manual_control  std_msgs/Bool, latched; true with every command, false afterwards:
//                        navigate_path pauses its drive and yields
//
// Guaranteed: it takes over with the first message with the deadman button held. A zero is published
// when the deadman button is released, when no message has come for joy_timeout of the wall clock, on
// a message that cannot be used, and when the node ends; after that nothing is published, so that
// navigate_path may command the vehicle. ROS time has no effect. The node does not start where
// another joystick's, or one that does not yield, publishes cmd_vel. Not guaranteed: a zero after
// SIGKILL.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/steady_timer.h>
#include <ros/subscriber.h>
#include <sensor_msgs/Joy.h>
#include <std_msgs/Bool.h>

#include <memory>
#include <optional>

#include "ros/common/master/command_claim.h"
#include "ros/driving/teleop_joy_options.h"

namespace grid_path_planner {
class TeleopJoyConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class TeleopJoyNode {
 public:
  // Throws InputError for parameters that cannot be used and another node that commands. All callbacks are served by the queue of
  // `nh`, which must be one thread's.
  TeleopJoyNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh);
  // Stops the vehicle if it is being driven.
  ~TeleopJoyNode();

 private:
  void use(const TeleopJoyOptions& options);
  void startTimer();
  void onJoy(const sensor_msgs::Joy& message);
  void onStop(const std_msgs::Bool& message);
  void onTimer(const ros::SteadyTimerEvent& event);
  void command(const base::BodyVelocity& velocity);
  void publish(const base::BodyVelocity& velocity);
  void announce(bool manual);
  void release();

  ros::NodeHandle nh_;
  TeleopJoyOptions options_;
  const CommandClaim commands_;
  std::optional<base::BodyVelocity> velocity_;  // none: the joystick commands nothing
  bool stopped_ = false;                        // by the topic
  ros::SteadyTime heard_;
  ros::Publisher publisher_;
  ros::Publisher manual_publisher_;
  ros::Subscriber subscriber_;
  ros::Subscriber stop_subscriber_;
  ros::SteadyTimer timer_;
  std::unique_ptr<Reconfigurable<TeleopJoyConfig, TeleopJoyOptions>> reconfigurable_;
};

}  // namespace grid_path_planner::nodes
