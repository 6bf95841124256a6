#include "ros/avoidance/flight_commander.h"

#include <geometry_msgs/TwistStamped.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ros/guard/clock.h"
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
                                 std::function<void(unsigned)> on_handover)
    : gate_(nh, owner(std::move(on_handover))),
      setpoint_(gate_.handle().advertise<geometry_msgs::TwistStamped>("setpoint_velocity", 10)) {
  use(options);
  gate_.start({options.control_rate, options.realtime_priority});
}

FlightCommander::~FlightCommander() {
  finish();
  gate_.thread().stop();
}

CommandGate::Owner FlightCommander::owner(std::function<void(unsigned)> on_handover) {
  CommandGate::Owner owner;
  owner.tick = [this] { tick(); };
  owner.time_went_back = [this](double) { command_.velocity = {}; };
  owner.drives = [this] { return hold_.flies(); };
  owner.on_handover = std::move(on_handover);
  owner.on_manual = [this](bool commands) { hold_.manual(commands); };
  owner.on_refused = [this] { ++refused_; };
  return owner;
}

// In the thread, so that no joystick takes over meanwhile.
bool FlightCommander::begin(unsigned handovers) {
  return gate_.thread().ask([this, handovers] {
    hold_.begin(gate_.isManual());
    return handovers == gate_.handovers();
  });
}

std::string FlightCommander::hold() const {
  if (const auto why = gate_.problem(master_timeout_)) return *why;
  if (gate_.isManual()) return "the joystick commands: paused until ~resume";
  return hold_.paused() ? "paused until ~resume" : "";
}

void FlightCommander::command(const Command& command) {
  gate_.thread().post([this, command, now = Clock::now()] { take(command, now); });
}

void FlightCommander::setOptions(const LocalPlannerOptions& options) {
  gate_.thread().ask([this, &options] {
    use(options);
    gate_.setSchedule({options.control_rate, options.realtime_priority});
  });
}

void FlightCommander::finish() {
  gate_.finish([this] {
    if (flies_) send({});
    flies_ = false;
  });
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

void FlightCommander::take(const Command& command, Clock::time_point handed_over) {
  command_ = finite(command);
  handed_over_ = handed_over;
  brakes_since_.reset();
  flies_ = true;
  gate_.thread().restartPeriod();
  gate_.thread().tick();
}

// The last command is given again until it was sent.
void FlightCommander::tick() {
  if (!hold().empty()) command_.velocity = {};
  if (!brakes_since_ && !command_.velocity.isZero() && isOverdue()) beginToBrake();
  send(flies_ ? due() : BodyVelocity{});
  if (command_.is_last) flies_ = false;
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
  const auto sent = gate_.send(velocity, flies_);
  if (!sent) return;
  const Eigen::Vector3d in_map = base::inMap(*sent, command_.yaw);
  geometry_msgs::TwistStamped stamped;
  stamped.header.frame_id = map_frame_;
  stamped.header.stamp = ros::Time::now();
  stamped.twist = velocityToMessage({in_map.x(), in_map.y(), sent->heave, sent->yaw_rate});
  setpoint_.publish(stamped);
}

}  // namespace grid_path_planner::nodes
