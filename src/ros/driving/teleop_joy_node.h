// The node `teleop_joy`: a vehicle driven by joystick.
//
//   subscribes  joy      sensor_msgs/Joy; its driver must repeat (joy_node's ~autorepeat_rate)
//               stop     std_msgs/Bool; zeros while it is true
//   publishes   cmd_vel  geometry_msgs/Twist in base_link, while the deadman button is held
//               manual_control  std_msgs/Bool; true before every command, false afterwards:
//                        navigate_path pauses its drive and yields
//               /diagnostics
//
// Guaranteed: it takes over with the first message with the deadman button held. A zero is published
// when the deadman button is released, when no message has come for joy_timeout of the wall clock, on
// a message that cannot be used, and when the node ends; after that nothing is published, so that
// navigate_path may command the vehicle. ROS time has no effect. The node does not start where
// another joystick's, or one that does not yield, publishes cmd_vel; one that comes later is told in /diagnostics. Velocities come from JoystickLoop,
// whose thread waits for nothing; this class logs. Not guaranteed: a zero after SIGKILL.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <atomic>
#include <memory>
#include <string>

#include "ros/driving/joystick_loop.h"
#include "ros/driving/teleop_joy_options.h"
#include "ros/guard/master/command_claim.h"
#include "ros/guard/master/other_commanders.h"

namespace grid_path_planner {
class TeleopJoyConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class TeleopJoyNode {
 public:
  // Throws InputError for parameters that cannot be used and another node that commands. All callbacks
  // but the loop's are served by the queue of `nh`, which must be one thread's.
  TeleopJoyNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh);
  // Stops the vehicle if it is being driven.
  ~TeleopJoyNode();

  // The same, and nothing is commanded any more. Thread-safe.
  void stop() { loop_->finish(); }

 private:
  void use(const TeleopJoyOptions& options);
  void note(JoystickLoop::Level level, const std::string& sentence);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle nh_;
  TeleopJoyOptions options_;
  const CommandClaim commands_;
  OtherCommanders others_{commands_};
  diagnostic_updater::Updater diagnostics_;
  ros::SteadyTimer diagnostics_timer_;
  // That wait for the log; shared with them, since they may outlive a node that does not start.
  const std::shared_ptr<std::atomic<int>> notes_ = std::make_shared<std::atomic<int>>(0);
  std::unique_ptr<JoystickLoop> loop_;
  std::unique_ptr<Reconfigurable<TeleopJoyConfig, TeleopJoyOptions>> reconfigurable_;
};

}  // namespace grid_path_planner::nodes
