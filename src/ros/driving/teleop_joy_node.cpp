#include "ros/driving/teleop_joy_node.h"

#include <geometry_msgs/Twist.h>
#include <ros/console.h>

#include "grid_path_planner/TeleopJoyConfig.h"
#include "grid_path_planner/base/options.h"
#include "ros/common/incoming/claimed_lengths.h"
#include "ros/common/parameters.h"

namespace grid_path_planner::nodes {

using base::BodyVelocity;
using base::checkOptionLimits;
using base::InputError;
using following::JoystickState;
using following::joystickVelocity;

namespace {

constexpr double kErrorPeriod = 5.0;  // s, between two of the same

TeleopJoyOptions loadTeleopJoyOptions(const ros::NodeHandle& private_nh) {
  TeleopJoyOptions options;
  loadParameters(private_nh, options);
  checkTeleopJoyOptions(options);
  warnUnknownParameters(private_nh, optionNames<TeleopJoyOptions>());
  return options;
}

JoystickState stateOf(const sensor_msgs::Joy& message) {
  JoystickState state;
  state.axes.assign(message.axes.begin(), message.axes.end());
  for (const auto button : message.buttons) state.buttons.push_back(button != 0);
  return state;
}

}  // namespace

void checkTeleopJoyOptions(const TeleopJoyOptions& options) {
  checkOptionLimits(options);
}

TeleopJoyNode::TeleopJoyNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh)
    : nh_(nh),
      options_(loadTeleopJoyOptions(private_nh)),
      commands_(private_nh.getNamespace(),
                {{nh.resolveName("cmd_vel")}, {}, nh.resolveName("manual_control"), true}) {
  manual_publisher_ = nh_.advertise<std_msgs::Bool>("manual_control", 1, true);
  publisher_ = nh_.advertise<geometry_msgs::Twist>("cmd_vel", 10);
  commands_.refuseSimultaneous();
  stop_subscriber_ = subscribeChecked<std_msgs::Bool>(
      nh_, "stop", 1, [this](const std_msgs::Bool& message) { onStop(message); });
  subscriber_ = subscribeChecked<sensor_msgs::Joy>(
      nh_, "joy", 10, [this](const sensor_msgs::Joy& message) { onJoy(message); });
  reconfigurable_ = std::make_unique<Reconfigurable<TeleopJoyConfig, TeleopJoyOptions>>(
      private_nh, options_, [this](const TeleopJoyOptions& options) { use(options); });
  startTimer();
}

TeleopJoyNode::~TeleopJoyNode() {
  timer_.stop();
  if (!velocity_) return;
  release();
  if (publisher_.getNumSubscribers() > 0)
    ros::WallDuration(0.1).sleep();  // roscpp sends in a thread of its own and says not when it has
}

void TeleopJoyNode::use(const TeleopJoyOptions& options) {
  checkTeleopJoyOptions(options);
  const bool other_rate = options.command_rate != options_.command_rate;
  options_ = options;
  if (other_rate) startTimer();
}

void TeleopJoyNode::startTimer() {
  timer_ = nh_.createSteadyTimer(ros::WallDuration(1.0 / options_.command_rate),
                                 &TeleopJoyNode::onTimer, this);
}

void TeleopJoyNode::onJoy(const sensor_msgs::Joy& message) {
  heard_ = ros::SteadyTime::now();
  try {
    const auto velocity = joystickVelocity(options_.joystick, stateOf(message));
    if (velocity)
      command(*velocity);
    else
      release();
  } catch (const InputError& error) {
    ROS_ERROR_STREAM_THROTTLE(kErrorPeriod, "joy refused: " << error.what());
    release();
  }
}

void TeleopJoyNode::onStop(const std_msgs::Bool& message) {
  stopped_ = message.data;
  if (stopped_) publish({});
}

// The first command at once.
void TeleopJoyNode::command(const BodyVelocity& velocity) {
  const bool takes_over = !velocity_;
  velocity_ = velocity;
  if (!takes_over) return;
  ROS_INFO("The joystick commands");
  announce(true);
  publish(stopped_ ? BodyVelocity{} : velocity);
}

void TeleopJoyNode::onTimer(const ros::SteadyTimerEvent&) {
  if (!velocity_) {
    if (stopped_) publish({});
    return;
  }
  const double silence = (ros::SteadyTime::now() - heard_).toSec();
  if (silence > options_.joy_timeout) {
    ROS_WARN_STREAM("Nothing has come from the joystick for " << silence
                                                              << " s: the vehicle is stopped");
    release();
    return;
  }
  announce(true);
  publish(stopped_ ? BodyVelocity{} : *velocity_);
}

void TeleopJoyNode::announce(bool manual) {
  std_msgs::Bool message;
  message.data = manual;
  manual_publisher_.publish(message);
}

void TeleopJoyNode::publish(const BodyVelocity& velocity) {
  geometry_msgs::Twist message;
  message.linear.x = velocity.surge;
  message.linear.y = velocity.sway;
  message.linear.z = velocity.heave;
  message.angular.z = velocity.yaw_rate;
  publisher_.publish(message);
}

void TeleopJoyNode::release() {
  if (!velocity_) return;
  velocity_.reset();
  publish({});
  announce(false);
  ROS_INFO("The joystick commands no longer");
}

}  // namespace grid_path_planner::nodes
