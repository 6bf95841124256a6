#include "ros/driving/joystick_loop.h"

#include <utility>

#include "base/seconds_since.h"
#include "ros/guard/incoming/claimed_lengths.h"

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
    : note_(std::move(note)),
      options_(options),
      gate_(nh, owner(), CommandGate::Joystick::OWN),
      manual_publisher_(gate_.handle().advertise<std_msgs::Bool>("manual_control", 10)) {}

JoystickLoop::~JoystickLoop() {
  if (!started_) return;
  finish();
  gate_.thread().stop();
}

CommandGate::Owner JoystickLoop::owner() {
  CommandGate::Owner owner;
  owner.tick = [this] { tick(); };
  owner.drives = [this] { return commands_.load(); };
  owner.on_refused = [this] { refuse("a message on stop has the bytes of another"); };
  return owner;
}

void JoystickLoop::start() {
  gate_.start({options_.command_rate, options_.realtime_priority});
  joy_subscriber_ = subscribeChecked<sensor_msgs::Joy>(
      gate_.handle(), "joy", 10, [this](const sensor_msgs::Joy& message) { onJoy(message); },
      [this] { refuse("a message on joy has the bytes of another"); });
  started_ = true;
}

void JoystickLoop::setOptions(const TeleopJoyOptions& options) {
  gate_.thread().ask([this, &options] {
    options_ = options;
    gate_.setSchedule({options.command_rate, options.realtime_priority});
  });
}

void JoystickLoop::finish() {
  gate_.finish([this] { release(); });
}

void JoystickLoop::onJoy(const sensor_msgs::Joy& message) {
  if (gate_.finished()) return;
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

// The first command at once.
void JoystickLoop::command(const BodyVelocity& velocity) {
  const bool takes_over = !std::exchange(velocity_, velocity);
  if (!takes_over) return;
  commands_ = true;
  announce(true);
  gate_.send(velocity, true);
  note_(Level::INFO, "The joystick commands");
}

void JoystickLoop::tick() {
  if (!velocity_) {
    release();
    gate_.send({}, false);
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
  gate_.send(*velocity_, true);
}

void JoystickLoop::announce(bool commands) {
  std_msgs::Bool message;
  message.data = commands;
  manual_publisher_.publish(message);
}

// What could not be sent for want of memory is sent by the next tick.
void JoystickLoop::release() {
  if (!commands_) return;
  velocity_.reset();
  gate_.send({}, false);
  announce(false);
  commands_ = false;
  note_(Level::INFO, "The joystick commands no longer");
}

}  // namespace grid_path_planner::nodes
