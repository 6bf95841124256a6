#include "ros/driving/teleop_joy_node.h"

#include <geometry_msgs/Twist.h>
#include <ros/console.h>

#include "grid_path_planner/TeleopJoyConfig.h"
#include "grid_path_planner/base/options.h"
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
    : nh_(nh), options_(loadTeleopJoyOptions(private_nh)) {
  publisher_ = nh_.advertise<geometry_msgs::Twist>("cmd_vel", 10);
  subscriber_ = nh_.subscribe("joy", 10, &TeleopJoyNode::onJoy, this);
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
      velocity_ = velocity;
    else
      release();
  } catch (const InputError& error) {
    ROS_ERROR_STREAM_THROTTLE(kErrorPeriod, "joy refused: " << error.what());
    release();
  }
}

void TeleopJoyNode::onTimer(const ros::SteadyTimerEvent&) {
  if (!velocity_) return;
  const double silence = (ros::SteadyTime::now() - heard_).toSec();
  if (silence > options_.joy_timeout) {
    ROS_WARN_STREAM("Nothing has come from the joystick for " << silence
                                                              << " s: the vehicle is stopped");
    release();
    return;
  }
  publish(*velocity_);
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
}

}  // namespace grid_path_planner::nodes
