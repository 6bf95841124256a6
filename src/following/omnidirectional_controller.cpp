#include "following/omnidirectional_controller.h"

#include <algorithm>
#include <cmath>

#include "vehicle/description.h"

namespace grid_path_planner::following {

using path::Pose;

namespace {

using Eigen::Vector3d;

Vector3d towards(const Vector3d& from, const Vector3d& to, double largest) {
  const Vector3d change = to - from;
  const double size = change.norm();
  return size > largest ? Vector3d(from + change * (largest / size)) : to;
}

// From the point of the route to that which is steered to.
Vector3d pursuitChord(const RoutePosition& position, double distance) {
  return position.route.ahead(position.segment, position.share, distance) - position.point();
}

// The share of `velocity` that is inside the limits in every direction, `most` in the plane among them, and upwards.
double speedScale(const Vector3d& velocity, double most, const FollowerOptions& options) {
  const double plane = velocity.head<2>().norm(), whole = velocity.norm();
  const double vertical = std::abs(velocity.z());
  double scale = 1.0;
  if (plane > most) scale = most / plane;
  if (whole * scale > options.max_speed) scale = options.max_speed / whole;
  if (vertical * scale > options.max_vertical_speed) scale = options.max_vertical_speed / vertical;
  return scale;
}

}  // namespace

double wantedYaw(const RoutePosition& position, const Pose& vehicle,
                 const FollowerOptions& options) {
  const Pose& from = position.route.knots()[position.segment].pose;
  const Knot& target = position.route.knots()[position.segment + 1];
  if (target.stop && position.at_stop) return target.pose.yaw;
  if (options.facing == FacingMode::ALONG) {
    const Vector3d chord = pursuitChord(position, options.pursuit_distance);
    if (chord.head<2>().norm() > options.position_tolerance)
      return std::atan2(chord.y(), chord.x());
    return target.stop ? target.pose.yaw : vehicle.yaw;
  }
  return from.yaw + position.share * angleBetween(from.yaw, target.pose.yaw);
}

Steering OmnidirectionalController::follow(const RoutePosition& position, const Pose& vehicle,
                                           double seconds, double pursuit) const {
  return limited(vehicle, wantedVelocity(position, vehicle.position, pursuit),
                 angleBetween(vehicle.yaw, wantedYaw(position, vehicle, options())), seconds);
}

// Along the path as fast as corners and stops allow, and towards it. The farther off the slower
// along; from the acceptance radius on only towards it.
Vector3d OmnidirectionalController::wantedVelocity(const RoutePosition& position,
                                                   const Vector3d& vehicle, double pursuit) const {
  const Vector3d off = position.point() - vehicle;
  const double distance = off.norm();

  const Vector3d chord = pursuitChord(position, pursuit * options().pursuit_distance);
  const double part = std::min(1.0, distance / options().acceptance_radius);
  const double along = std::sqrt(pursuit) *  // as corners allow whose rounding is that much shorter
                       position.route.speed(position.segment, position.share, options()) *
                       (1.0 - part * part);
  Vector3d velocity = Vector3d::Zero();
  if (chord.norm() > 1e-9) velocity = chord.normalized() * along;
  if (distance > 1e-9)
    velocity += off / distance *
                std::min(options().position_gain * distance,
                         std::sqrt(2.0 * 0.8 * options().max_acceleration * distance));
  return velocity;
}

Steering OmnidirectionalController::holdPose(const Pose& target, const Pose& vehicle,
                                             double seconds) const {
  const Vector3d off = target.position - vehicle.position;
  const double turn = angleBetween(vehicle.yaw, target.yaw);
  const double error =
      std::max(off.norm() / options().position_tolerance, std::abs(turn) / options().yaw_tolerance);
  if (!options().hold_pose || error <= (last(vehicle).returning ? 0.5 : 1.0)) return {};
  Steering steering = limited(vehicle, options().position_gain * off, turn, seconds);
  steering.returning = true;
  return steering;
}

// The share of the velocity that is inside what the vehicle can do along its axes.
double OmnidirectionalController::shareWithin(const Vector3d& velocity, double yaw) const {
  if (!vehicle_) return 1.0;
  const base::BodyVelocity v = base::inBody(velocity, yaw, 0.0);
  const double ahead = v.surge > 0.0 ? vehicle_->max_speed : vehicle_->max_backward_speed;
  const double share = std::min(
      ahead / std::max(std::abs(v.surge), ahead),
      vehicle_->max_sideways_speed / std::max(std::abs(v.sway), vehicle_->max_sideways_speed));
  return share;
}

// In the body frame, inside the limits of speed and of its change since the last one.
Steering OmnidirectionalController::limited(const Pose& vehicle, const Vector3d& velocity,
                                            double yaw_error, double seconds) const {
  const Steering before = last(vehicle);
  const double most = speedScale(velocity, speedLimit(), options());
  const Vector3d wanted = velocity * (most * shareWithin(velocity * most, vehicle.yaw));
  Steering steering;
  steering.yaw = vehicle.yaw;
  steering.velocity = towards(before.velocity, wanted, options().max_acceleration * seconds);
  steering.velocity *= shareWithin(steering.velocity, vehicle.yaw);
  const double rate = towards(before.command.yaw_rate, yawRateFor(yaw_error, options()),
                              options().max_yaw_acceleration * seconds);
  steering.command = base::inBody(steering.velocity, vehicle.yaw, rate);
  return steering;
}

}  // namespace grid_path_planner::following
