#include "ros/driving/joystick_loop.h"

#include <utility>

#include "base/seconds_since.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/master/system_state.h"
#include "ros/messages/velocity_message.h"

namespace grid_path_planner::nodes {

using base::BodyVelocity;
using following::JoystickState;
using following::joystickVelocity;

namespace {

constexpr std::chrono::seconds kRefusalPeriod(5);  // between two that are told

JoystickState stateOf(const sensor_msgs::Joy& message) {
  JoystickState state;
  state.axes.assign(message.axes.begin(), message.axes.end());
  for (const auto button : message.buttons) state.buttons.push_back(button != 0);
  return state;
}

}  // namespace

JoystickLoop::JoystickLoop(const ros::NodeHandle& nh, const TeleopJoyOptions& options, Note note)
    : nh_(nh),
      note_(std::move(note)),
      options_(options),
      publisher_(nh_.advertise<geometry_msgs::Twist>("cmd_vel", 10)),
      manual_publisher_(nh_.advertise<std_msgs::Bool>("manual_control", 10)) {
  nh_.setCallbackQueue(&thread_.queue());
}

JoystickLoop::~JoystickLoop() {
  if (!started_) return;
  finish();
  thread_.stop();
}

void JoystickLoop::start() {
  const auto refused = [this] { refuse("a message on joy or stop has the bytes of another"); };
  stop_subscriber_ = subscribeChecked<std_msgs::Bool>(
      nh_, "stop", 1, [this](const std_msgs::Bool& message) { onStop(message); }, refused);
  waitForPublishers(stop_subscriber_);
  joy_subscriber_ = subscribeChecked<sensor_msgs::Joy>(
      nh_, "joy", 10, [this](const sensor_msgs::Joy& message) { onJoy(message); }, refused);
  thread_.start(options_.command_rate, options_.realtime_priority);
  started_ = true;
}

void JoystickLoop::setOptions(const TeleopJoyOptions& options) {
  thread_.ask([this, &options] {
    options_ = options;
    thread_.setRate(options.command_rate);
    thread_.setPriority(options.realtime_priority);
  });
}

void JoystickLoop::finish() {
  bool sent = false;
  thread_.askAtLast([&] {
    finished_ = true;
    sent = release() || sent;
  });
  if (sent && publisher_.numberOfListeners() > 0)
    ros::WallDuration(0.1).sleep();  // what a connection did not take is sent by roscpp's thread
}

void JoystickLoop::onJoy(const sensor_msgs::Joy& message) {
  if (finished_) return;
  heard_ = Clock::now();
  try {
    const auto velocity = joystickVelocity(options_.joystick, stateOf(message));
    if (velocity)
      command(*velocity);
    else
      release();
  } catch (const base::InputError& error) {
    refuse(std::string("joy: ") + error.what());
    release();
  }
}

void JoystickLoop::refuse(const std::string& why) {
  const auto now = Clock::now();
  if (refused_ && now - *refused_ < kRefusalPeriod) return;
  refused_ = now;
  note_(Level::ERROR, "Refused: " + why);
}

void JoystickLoop::onStop(const std_msgs::Bool& message) {
  stopped_ = message.data;
  if (stopped_ && !finished_) publish({});
}

// The first command at once.
void JoystickLoop::command(const BodyVelocity& velocity) {
  const bool takes_over = !std::exchange(velocity_, velocity);
  if (!takes_over) return;
  commands_ = true;
  announce(true);
  publish(stopped_ ? BodyVelocity{} : velocity);
  note_(Level::INFO, "The joystick commands");
}

void JoystickLoop::tick() {
  if (finished_) return;
  if (!velocity_) {
    if (!release() && stopped_) publish({});
    return;
  }
  const double silence = base::secondsSince(heard_);
  if (silence > options_.joy_timeout) {
    release();
    note_(Level::WARN, "Nothing has come from the joystick for " + std::to_string(silence) +
                           " s: the vehicle is stopped");
    return;
  }
  announce(true);
  publish(stopped_ ? BodyVelocity{} : *velocity_);
}

void JoystickLoop::publish(const BodyVelocity& velocity) {
  publisher_.publish(velocityToMessage(velocity));
}

void JoystickLoop::announce(bool commands) {
  std_msgs::Bool message;
  message.data = commands;
  manual_publisher_.publish(message);
}

// Whether it commanded. What could not be sent for want of memory is sent by the next tick.
bool JoystickLoop::release() {
  if (!commands_) return false;
  velocity_.reset();
  publish({});
  announce(false);
  commands_ = false;
  note_(Level::INFO, "The joystick commands no longer");
  return true;
}

}  // namespace grid_path_planner::nodes
