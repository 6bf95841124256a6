// The control loop of teleop_joy: a thread of its own that turns what the joystick says into cmd_vel.
//
//   JoystickLoop loop(nh, options, [](JoystickLoop::Level, const std::string&) {});
//   loop.start();
//   loop.finish();                                // a zero, if the joystick commands
//
// It serves `joy`; what is sent, and `stop`: command_gate.h. Guaranteed: the thread logs nothing, publishes nothing but
// cmd_vel and manual_control, which it writes to their connections itself, manual_control before the velocity, and takes
// no lock that code holds which does.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <sensor_msgs/Joy.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "ros/driving/teleop_joy_options.h"
#include "ros/gate/command_gate.h"
#include "ros/guard/outgoing/direct_publisher.h"

namespace grid_path_planner::nodes {

class JoystickLoop {
 public:
  enum class Level { INFO, WARN, ERROR };

  // What the log is to say. Called in the loop's thread; it may not wait.
  using Note = std::function<void(Level, const std::string& sentence)>;

  // Advertises.
  JoystickLoop(const ros::NodeHandle& nh, const TeleopJoyOptions& options, Note note);
  ~JoystickLoop();

  // Listens to the joystick from now on. To be called once, before what follows.
  void start();
  void setOptions(const TeleopJoyOptions& options);  // precondition: checked
  // Stops the vehicle if it is being driven; nothing is commanded after this. Waits until the zero is sent.
  // Thread-safe.
  void finish();

  bool commands() const { return commands_; }
  const CommandGate& gate() const { return gate_; }

 private:
  using Clock = std::chrono::steady_clock;

  CommandGate::Owner owner();
  // In the thread:
  void onJoy(const sensor_msgs::Joy& message);
  void refuse(const std::string& why);
  void tick();
  void command(const base::BodyVelocity& velocity);
  void announce(bool commands);
  void release();

  const Note note_;
  TeleopJoyOptions options_;
  std::optional<base::BodyVelocity> velocity_;  // none: the joystick commands nothing
  Clock::time_point heard_;
  std::optional<Clock::time_point> refused_;  // when that was told last
  std::atomic<bool> commands_{false};         // until the zero is sent
  bool started_ = false;

  CommandGate gate_;
  DirectPublisher manual_publisher_;
  ros::Subscriber joy_subscriber_;
};

}  // namespace grid_path_planner::nodes
