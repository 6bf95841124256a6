#include "ros/gate/command_gate.h"

#include <utility>

#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/master/system_state.h"
#include "ros/messages/velocity_message.h"

namespace grid_path_planner::nodes {

using base::BodyVelocity;

namespace {

constexpr std::chrono::milliseconds kClockTimeout(500);  // by the wall clock

}  // namespace

CommandGate::CommandGate(const ros::NodeHandle& nh, Owner owner, Joystick joystick)
    : owner_(std::move(owner)),
      whose_(joystick),
      nh_(nh),
      velocity_(nh_.advertise<geometry_msgs::Twist>("cmd_vel", 10)) {
  nh_.setCallbackQueue(&thread_.queue());
}

CommandGate::~CommandGate() {
  thread_.stop();
}

void CommandGate::start(const Schedule& schedule) {
  stop_subscriber_ = subscribeChecked<std_msgs::Bool>(
      nh_, "stop", 1, [this](const std_msgs::Bool& message) { onStop(message); },
      owner_.on_refused);
  // Taken over and let go at once, as where both come late, is taken over.
  if (whose_ == Joystick::HEEDED)
    manual_subscriber_ = subscribeChecked<std_msgs::Bool>(
        nh_, "manual_control", 10, [this](const std_msgs::Bool& message) { onManual(message); },
        owner_.on_refused);
  waitForPublishers(stop_subscriber_);
  thread_.start(schedule.rate, schedule.priority);
}

void CommandGate::setSchedule(const Schedule& schedule) {
  thread_.setRate(schedule.rate);
  thread_.setPriority(schedule.priority);
}

void CommandGate::finish(const std::function<void()>& last) {
  bool sent = false;
  thread_.askAtLast([&] {  // what it throws has it done again: the last zero is sent
    if (finished_) return;
    sent = sent || !silent_;
    send({}, false);  // before anything that wants memory
    last();
    finished_ = true;
  });
  if (sent)
    ros::WallDuration(0.1).sleep();  // what a connection did not take is sent by roscpp's thread
}

void CommandGate::tick() {
  noteClock();
  if (finished_) return;
  bool has_expired = false;
  {
    const Lock lock(mutex_);
    has_expired = joystick_.expire();
  }
  if (has_expired) {
    silent_ = false;  // a node that was killed has sent no zero
    noteHandover();
  }
  owner_.tick();
}

// In a catch block. The zero goes out before anything else that wants memory.
void CommandGate::giveUpTick() {
  if (finished_) return;
  send({}, owner_.drives());
  owner_.give_up();
}

void CommandGate::noteClock() {
  const ros::Time now = ros::Time::isValid() ? ros::Time::now() : ros::Time();
  const Lock lock(mutex_);
  if (std::exchange(now_, now) != now) moved_ = Clock::now();
}

std::optional<BodyVelocity> CommandGate::send(const BodyVelocity& velocity, bool driven) {
  if (finished_) return std::nullopt;
  const bool stands = stopped();
  if (!stands && isManual()) {
    silent_ = true;  // the joystick's velocities are in force, and its zero when it is let go
    const Lock lock(mutex_);
    sent_ = {};
    return std::nullopt;
  }
  const BodyVelocity command = stands ? BodyVelocity{} : velocity;
  if (!driven && !stands && command.isZero() && silent_) return std::nullopt;
  {
    const Lock lock(mutex_);
    sent_ = command;
  }
  velocity_.publish(velocityToMessage(command));
  silent_ = !driven && command.isZero();  // sent: what threw is tried again
  return command;
}

void CommandGate::onStop(const std_msgs::Bool& message) {
  {
    const Lock lock(mutex_);
    if (std::exchange(stopped_, message.data) == message.data) return;
  }
  thread_.tick();
}

void CommandGate::onManual(const std_msgs::Bool& message) {
  if (finished_) return;
  bool is_change = false;
  {
    const Lock lock(mutex_);
    is_change = joystick_.hear(message.data);
  }
  owner_.on_manual(message.data);
  if (!is_change) return;
  noteHandover();
  thread_.tick();
}

// None of what is driven: it is paused, and resumed by hand.
void CommandGate::noteHandover() {
  if (owner_.drives()) return;
  unsigned handovers = 0;
  {
    const Lock lock(mutex_);
    handovers = ++handovers_;
  }
  owner_.on_handover(handovers);
}

bool CommandGate::stopped() const {
  const Lock lock(mutex_);
  return stopped_;
}

bool CommandGate::isManual() const {
  const Lock lock(mutex_);
  return joystick_.commands();
}

unsigned CommandGate::handovers() const {
  const Lock lock(mutex_);
  return handovers_;
}

BodyVelocity CommandGate::sent() const {
  const Lock lock(mutex_);
  return sent_;
}

bool CommandGate::clockStands() const {
  const Lock lock(mutex_);
  return Clock::now() - moved_ > kClockTimeout;
}

std::optional<std::string> CommandGate::problem(double master_timeout) const {
  if (stopped()) return "stopped by the topic " + stop_subscriber_.getTopic();
  if (clockStands()) return "ROS time stands still: no /clock comes";
  if (master_timeout > 0.0 && master_->silence() > master_timeout)
    return "the ROS master has not answered for longer than master_timeout";
  return std::nullopt;
}

}  // namespace grid_path_planner::nodes
