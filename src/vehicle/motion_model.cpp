#include "vehicle/motion_model.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::vehicle {

using base::BodyVelocity;

namespace {

constexpr double kStraight = 1e-9;  // rad, of a turn whose arc is a line

double approached(double value, double target, double share, double largest_change) {
  return value + std::clamp(share * (target - value), -largest_change, largest_change);
}

BodyVelocity between(const BodyVelocity& a, const BodyVelocity& b) {
  return {0.5 * (a.surge + b.surge), 0.5 * (a.sway + b.sway), 0.5 * (a.heave + b.heave),
          0.5 * (a.yaw_rate + b.yaw_rate)};
}

}  // namespace

PlanarState alongArc(const PlanarState& state, double seconds) {
  const double turn = state.velocity.yaw_rate * seconds;
  const Eigen::Vector2d driven(state.velocity.surge * seconds, state.velocity.sway * seconds);
  // Of the arc's chord: sin(turn)/turn along the velocity, (1 - cos(turn))/turn across it.
  const bool straight = std::abs(turn) < kStraight;
  const double along = straight ? 1.0 : std::sin(turn) / turn;
  const double across = straight ? 0.0 : (1.0 - std::cos(turn)) / turn;
  const Eigen::Vector2d chord(along * driven.x() - across * driven.y(),
                              across * driven.x() + along * driven.y());
  PlanarState end = state;
  const double c = std::cos(state.yaw), s = std::sin(state.yaw);
  end.position += Eigen::Vector2d(c * chord.x() - s * chord.y(), s * chord.x() + c * chord.y());
  end.yaw += turn;
  return end;
}

BodyVelocity MotionModel::feasible(const BodyVelocity& command) const {
  BodyVelocity v = command;
  v.surge = std::clamp(v.surge, -vehicle_.max_backward_speed, vehicle_.max_speed);
  v.sway = std::clamp(v.sway, -vehicle_.max_sideways_speed, vehicle_.max_sideways_speed);
  v.heave = std::clamp(v.heave, -vehicle_.max_vertical_speed, vehicle_.max_vertical_speed);
  v.yaw_rate = std::clamp(v.yaw_rate, -vehicle_.max_yaw_rate, vehicle_.max_yaw_rate);
  if (vehicle_.drive == Drive::CAR) v.yaw_rate = turnedByCar(v);
  return v;
}

double MotionModel::turnedByCar(const BodyVelocity& velocity) const {
  const double fastest = std::abs(velocity.surge) / vehicle_.least_turning_radius;
  return std::clamp(velocity.yaw_rate, -fastest, fastest);
}

PlanarState MotionModel::advanced(const PlanarState& state, const BodyVelocity& command,
                                  double seconds) const {
  const BodyVelocity target = feasible(command);
  const double share =
      vehicle_.time_constant > 0.0 ? -std::expm1(-seconds / vehicle_.time_constant) : 1.0;
  const double most = vehicle_.max_acceleration * seconds;
  const BodyVelocity& before = state.velocity;
  BodyVelocity after = before;
  after.surge = approached(before.surge, target.surge, share, most);
  after.sway = approached(before.sway, target.sway, share, most);
  after.heave = approached(before.heave, target.heave, share, most);
  after.yaw_rate =
      approached(before.yaw_rate, target.yaw_rate, share, vehicle_.max_yaw_acceleration * seconds);
  if (vehicle_.drive == Drive::CAR) after.yaw_rate = turnedByCar(after);
  PlanarState driven = state;
  driven.velocity = between(before, after);
  driven = alongArc(driven, seconds);
  driven.velocity = after;
  return driven;
}

}  // namespace grid_path_planner::vehicle
