#include "ros/avoidance/flight_commander.h"

#include <geometry_msgs/TwistStamped.h>

#include <algorithm>
#include <utility>

#include "ros/common/clock.h"
#include "ros/common/incoming/claimed_lengths.h"
#include "ros/common/velocity_message.h"

namespace grid_path_planner::nodes {

using base::BodyVelocity;

namespace {

// Of control_rate, at least: the next plan may be a little late.
constexpr double kPeriodsHeld = 1.5;

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
  stop_subscriber_ = subscribeChecked<std_msgs::Bool>(
      own, "stop", 1, [this](const std_msgs::Bool& message) { onStop(message); });
  manual_subscriber_ = subscribeChecked<std_msgs::Bool>(
      own, "manual_control", 1, [this](const std_msgs::Bool& message) { onManual(message); });
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
  const bool sent = thread_.ask([this] {
    finished_ = true;
    const bool commands = std::exchange(flies_, false);
    if (commands) send({});
    return commands;
  });
  if (sent && velocity_.numberOfListeners() + setpoint_.numberOfListeners() > 0)
    ros::WallDuration(0.1).sleep();  // what a connection did not take is sent by roscpp's thread
}

void FlightCommander::use(const LocalPlannerOptions& options) {
  map_frame_ = options.map_frame;
  master_timeout_ = options.master_timeout;
  const std::chrono::duration<double> most(
      std::max(options.pilot.frame_period, kPeriodsHeld / options.control_rate));
  most_held_ = std::chrono::duration_cast<Clock::duration>(most);
}

void FlightCommander::take(const Command& command, Clock::time_point handed_over) {
  command_ = command;
  handed_over_ = handed_over;
  flies_ = true;
  thread_.restartPeriod();
  thread_.tick();
  flies_ = !command.is_last;
}

void FlightCommander::onStop(const std_msgs::Bool& message) {
  hold_.stop(message.data);
  thread_.tick();
}

void FlightCommander::onManual(const std_msgs::Bool& message) {
  hold_.manual(message.data);
}

void FlightCommander::tick() {
  if (finished_) return;
  if (hold_.stopped()) return send({});
  if (!flies_ || hold_.isManual()) return;
  if (!hold_.why(master_timeout_).empty()) command_.velocity = {};
  if (!command_.velocity.isZero() && isOverdue()) {
    command_.velocity = {};
    ++overdue_;
  }
  send(command_.velocity);
}

bool FlightCommander::isOverdue() const {
  const double age = secondsBetween(command_.time, ros::Time::now());
  return Clock::now() - handed_over_ > most_held_ || age < 0.0 || age > command_.good_for;
}

void FlightCommander::send(const BodyVelocity& velocity) {
  velocity_.publish(velocityToMessage(velocity));
  const Eigen::Vector3d in_map = base::inMap(velocity, command_.yaw);
  geometry_msgs::TwistStamped stamped;
  stamped.header.frame_id = map_frame_;
  stamped.header.stamp = ros::Time::now();
  stamped.twist = velocityToMessage({in_map.x(), in_map.y(), velocity.heave, velocity.yaw_rate});
  setpoint_.publish(stamped);
}

}  // namespace grid_path_planner::nodes
