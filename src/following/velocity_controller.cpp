#include "following/velocity_controller.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace grid_path_planner::following {

using base::BodyVelocity;
using path::Pose;

namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

double towards(double from, double to, double largest) {
  return from + std::clamp(to - from, -largest, largest);
}

Vector3d towards(const Vector3d& from, const Vector3d& to, double largest) {
  const Vector3d change = to - from;
  const double size = change.norm();
  return size > largest ? Vector3d(from + change * (largest / size)) : to;
}

// From the point of the route to that which is steered to.
Vector3d pursuitChord(const RoutePosition& position, const FollowerOptions& options) {
  return position.route.ahead(position.segment, position.share, options.pursuit_distance) -
         position.point();
}

// The share of `velocity` that is inside the limits in the plane, `most` among them, and upwards.
double speedScale(const Vector3d& velocity, double most, const FollowerOptions& options) {
  const double plane = velocity.head<2>().norm();
  const double vertical = std::abs(velocity.z());
  const double fastest = std::min(most, options.max_speed);
  double scale = 1.0;
  if (plane > fastest) scale = fastest / plane;
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
    const Vector3d chord = pursuitChord(position, options);
    if (chord.head<2>().norm() > options.position_tolerance)
      return std::atan2(chord.y(), chord.x());
    return target.stop ? target.pose.yaw : vehicle.yaw;
  }
  return from.yaw + position.share * angleBetween(from.yaw, target.pose.yaw);
}

BodyVelocity VelocityController::follow(const RoutePosition& position, const Pose& vehicle,
                                        double seconds) {
  return limited(vehicle, wantedVelocity(position, vehicle.position),
                 angleBetween(vehicle.yaw, wantedYaw(position, vehicle, options_)), seconds);
}

// Along the path as fast as corners and stops allow, and towards it. The farther off the slower
// along; from the acceptance radius on only towards it.
Vector3d VelocityController::wantedVelocity(const RoutePosition& position,
                                            const Vector3d& vehicle) const {
  const Vector3d off = position.point() - vehicle;
  const double distance = off.norm();

  const Vector3d chord = pursuitChord(position, options_);
  const double part = std::min(1.0, distance / options_.acceptance_radius);
  const double along =
      position.route.speed(position.segment, position.share, options_) * (1.0 - part * part);
  Vector3d velocity = Vector3d::Zero();
  if (chord.norm() > 1e-9) velocity = chord.normalized() * along;
  if (distance > 1e-9)
    velocity += off / distance *
                std::min(options_.position_gain * distance,
                         std::sqrt(2.0 * 0.8 * options_.max_acceleration * distance));
  return velocity;
}

BodyVelocity VelocityController::holdPose(const Pose& target, const Pose& vehicle, double seconds) {
  const Vector3d off = target.position - vehicle.position;
  const double turn = angleBetween(vehicle.yaw, target.yaw);
  const double error =
      std::max(off.norm() / options_.position_tolerance, std::abs(turn) / options_.yaw_tolerance);
  returning_ = options_.hold_pose && error > (returning_ ? 0.5 : 1.0);
  if (!returning_) {
    stop();
    return {};
  }
  return limited(vehicle, options_.position_gain * off, turn, seconds);
}

void VelocityController::stop() {
  velocity_.setZero();
  yaw_rate_ = 0.0;
}

void VelocityController::changeFrame() {
  other_frame_ = true;
}

// In the body frame, inside the limits of speed and of its change since the last call.
BodyVelocity VelocityController::limited(const Pose& vehicle, const Vector3d& velocity,
                                         double yaw_error, double seconds) {
  if (std::exchange(other_frame_, false))
    velocity_ = AngleAxisd(vehicle.yaw - yaw_, Vector3d::UnitZ()) * velocity_;
  yaw_ = vehicle.yaw;
  velocity_ = towards(velocity_, velocity * speedScale(velocity, speed_limit_, options_),
                      options_.max_acceleration * seconds);

  const double braking = std::sqrt(2.0 * 0.8 * options_.max_yaw_acceleration * std::abs(yaw_error));
  const double fastest = std::min(options_.max_yaw_rate, braking);
  const double rate = std::clamp(options_.yaw_gain * yaw_error, -fastest, fastest);
  yaw_rate_ = towards(yaw_rate_, rate, options_.max_yaw_acceleration * seconds);

  const double c = std::cos(vehicle.yaw), s = std::sin(vehicle.yaw);
  return {c * velocity_.x() + s * velocity_.y(), -s * velocity_.x() + c * velocity_.y(),
          velocity_.z(), yaw_rate_};
}

}  // namespace grid_path_planner::following
