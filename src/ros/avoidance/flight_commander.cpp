#include "ros/avoidance/flight_commander.h"

#include <geometry_msgs/TwistStamped.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ros/guard/clock.h"
#include "ros/guard/incoming/claimed_lengths.h"
#include "ros/guard/master/system_state.h"
#include "ros/messages/velocity_message.h"

namespace grid_path_planner::nodes {

using base::BodyVelocity;

namespace {

// Of control_rate, at least: the next plan may be a little late.
constexpr double kPeriodsHeld = 1.5;

double nearerOf(double one, double other) {
  return std::abs(one) < std::abs(other) ? one : other;
}

double lessBy(double change, double speed) {
  return std::copysign(std::max(0.0, std::abs(speed) - change), speed);
}

// From where an axis is braked that had `measured` and was to have `commanded` for a while, in which it may have changed
// by `change`: never faster than either.
double brakedFrom(double measured, double commanded, double change) {
  const double reached = measured + std::clamp(commanded - measured, -change, change);
  return reached * commanded <= 0.0 ? 0.0 : nearerOf(reached, commanded);
}

// A stand, where a number is none, as the heading of a vehicle that odometry has turning at 1e308 rad/s.
FlightCommander::Command finite(FlightCommander::Command command) {
  if (command.velocity.isFinite() && command.measured.isFinite() && std::isfinite(command.yaw))
    return command;
  command.velocity = command.measured = {};
  command.yaw = 0.0;
  return command;
}

}  // namespace

FlightCommander::FlightCommander(const ros::NodeHandle& nh, const LocalPlannerOptions& options,
                                 FlightHold& hold)
    : hold_(hold),
      velocity_(ros::NodeHandle(nh).advertise<geometry_msgs::Twist>("cmd_vel", 10)),
      setpoint_(
          ros::NodeHandle(nh).advertise<geometry_msgs::TwistStamped>("setpoint_velocity", 10)) {
  use(options);
  ros::NodeHandle own(nh);
  own.setCallbackQueue(&thread_.queue());
  const auto refused = [this] { ++refused_; };
  stop_subscriber_ = subscribeChecked<std_msgs::Bool>(
      own, "stop", 1, [this](const std_msgs::Bool& message) { onStop(message); }, refused);
  // Taken over and let go at once, as where both come late, is taken over.
  manual_subscriber_ = subscribeChecked<std_msgs::Bool>(
      own, "manual_control", 10, [this](const std_msgs::Bool& message) { onManual(message); },
      refused);
  waitForPublishers(stop_subscriber_);
  thread_.start(options.control_rate, options.realtime_priority);
}

void FlightCommander::command(const Command& command) {
  thread_.post([this, command, now = Clock::now()] { take(command, now); });
}

void FlightCommander::setOptions(const LocalPlannerOptions& options) {
  thread_.ask([this, &options] {
    use(options);
    thread_.setRate(options.control_rate);
    thread_.setPriority(options.realtime_priority);
  });
}

void FlightCommander::finish() {
  bool sent = false;
  thread_.askAtLast([&] {
    finished_ = true;
    if (!flies_) return;
    send({});
    flies_ = false;
    sent = true;
  });
  if (sent && velocity_.numberOfListeners() + setpoint_.numberOfListeners() > 0)
    ros::WallDuration(0.1).sleep();  // what a connection did not take is sent by roscpp's thread
}

void FlightCommander::use(const LocalPlannerOptions& options) {
  map_frame_ = options.map_frame;
  master_timeout_ = options.master_timeout;
  max_acceleration_ = options.pilot.max_acceleration;
  frame_period_ = options.pilot.frame_period;
  const auto seconds = [](double number) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(number));
  };
  period_ = seconds(1.0 / options.control_rate);
  most_held_ = seconds(std::max(options.pilot.frame_period, kPeriodsHeld / options.control_rate));
}

BodyVelocity FlightCommander::sent() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return sent_;
}

void FlightCommander::keep(const BodyVelocity& sent) {
  const std::lock_guard<std::mutex> lock(mutex_);
  sent_ = sent;
}

void FlightCommander::take(const Command& command, Clock::time_point handed_over) {
  command_ = finite(command);
  handed_over_ = handed_over;
  brakes_since_.reset();
  flies_ = true;
  thread_.restartPeriod();
  thread_.tick();
}

void FlightCommander::onStop(const std_msgs::Bool& message) {
  hold_.stop(message.data);
  thread_.tick();
}

void FlightCommander::onManual(const std_msgs::Bool& message) {
  if (!finished_) hold_.manual(message.data);
}

// The last command is given again until it was sent.
void FlightCommander::tick() {
  if (finished_) return;
  sendCommand();
  if (command_.is_last) flies_ = false;
}

void FlightCommander::sendCommand() {
  if (!hold_.why(master_timeout_).empty()) command_.velocity = {};
  if (hold_.stopped()) return send({});
  if (hold_.isManual()) return keep({});
  if (!flies_) return;
  if (!brakes_since_ && !command_.velocity.isZero() && isOverdue()) beginToBrake();
  send(due());
}

bool FlightCommander::isOverdue() const {
  return Clock::now() - handed_over_ > most_held_ ||
         secondsBetween(command_.time, ros::Time::now()) > command_.good_for;
}

// From when it was to, though this thread has come to it later.
void FlightCommander::beginToBrake() {
  brakes_since_ = std::min(handed_over_ + most_held_, Clock::now());
  ++overdue_;
}

// Braking, it is what the vehicle may have at the end of the period that the velocity is in force for.
BodyVelocity FlightCommander::due() const {
  if (!brakes_since_) return command_.velocity;
  const std::chrono::duration<double> time = Clock::now() - *brakes_since_ + period_;
  const auto axis = [&](double BodyVelocity::*speed) {
    return lessBy(max_acceleration_ * time.count(),
                  brakedFrom(command_.measured.*speed, command_.velocity.*speed,
                             max_acceleration_ * frame_period_));
  };
  return {axis(&BodyVelocity::surge), axis(&BodyVelocity::sway), axis(&BodyVelocity::heave), 0.0};
}

void FlightCommander::send(const BodyVelocity& velocity) {
  keep(velocity);
  velocity_.publish(velocityToMessage(velocity));
  const Eigen::Vector3d in_map = base::inMap(velocity, command_.yaw);
  geometry_msgs::TwistStamped stamped;
  stamped.header.frame_id = map_frame_;
  stamped.header.stamp = ros::Time::now();
  stamped.twist = velocityToMessage({in_map.x(), in_map.y(), velocity.heave, velocity.yaw_rate});
  setpoint_.publish(stamped);
}

}  // namespace grid_path_planner::nodes
