#include "avoidance/steering/steering.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::avoidance {
namespace {

using base::inBody;
using Eigen::Vector3d;

constexpr double kShares[] = {1.0, 0.85, 0.7, 0.55, 0.4, 0.25, 0.12};
constexpr double kEscapeSpeed = 0.3;               // m/s
constexpr double kSteerNear = 0.4;                 // m ahead on the path to which it steers
constexpr double kSteerTime = 0.4;                 // s, the same for each metre a second
constexpr double kLookNear = 1.5, kLookFar = 5.0;  // m ahead on the path
constexpr double kAtEnd = 0.15;                    // m
constexpr double kLookAside = 30.0 * M_PI / 180.0;
// m before what was not seen, from where the camera sees all of the ball about the path
constexpr double kViewRoom = 1.1;
constexpr double kTurnGain = 2.0;  // 1/s
constexpr double kAhead =
    25.0 * M_PI / 180.0;  // of the path within which a vehicle without sway drives

// At most `speed`, and not above the limits of the vehicle.
Vector3d velocityTowards(const Vector3d& direction, double speed, const Motion& motion,
                         const PilotOptions& options) {
  const double length = direction.norm();
  if (length < 1e-9) return Vector3d::Zero();
  Vector3d velocity = direction * (std::min(speed, options.max_speed) / length);
  if (!options.elevation) velocity.z() = 0.0;
  if (!options.sway) {
    const double off = angleDifference(motion.yaw, std::atan2(direction.y(), direction.x()));
    const double surge = std::abs(off) > kAhead ? 0.0 : velocity.head<2>().norm() * std::cos(off);
    velocity.head<2>() = surge * Eigen::Vector2d(std::cos(motion.yaw), std::sin(motion.yaw));
  }
  const double climb = std::abs(velocity.z());
  return climb > options.max_climb ? Vector3d(velocity * (options.max_climb / climb)) : velocity;
}

double yawTo(const Vector3d& point, const Motion& motion) {
  const Vector3d direction = point - motion.position;
  return direction.head<2>().norm() < 0.3 ? motion.yaw : std::atan2(direction.y(), direction.x());
}

// m ahead on the path.
double steersTo(const Motion& motion) {
  return kSteerNear + kSteerTime * motion.velocity.norm();
}

// To where the path is not seen, but not far from where it leads next; without sway, along the path.
double wantedYaw(const Motion& motion, const FlownPath& path, const FlownPath::Clear& clear,
                 const PilotOptions& options) {
  if (!options.sway) return yawTo(path.ahead(steersTo(motion)), motion);
  const double next = yawTo(path.ahead(kLookNear), motion);
  const double far = std::clamp(clear.metres + 0.5, kLookNear, kLookFar);
  const double turn = angleDifference(next, yawTo(path.ahead(far), motion));
  return next + std::clamp(turn, -kLookAside, kLookAside);
}

// Who cannot sway looks along the path until its end is reached.
bool looksAlong(const Motion& motion, const FlownPath& path, const PilotOptions& options) {
  return !options.sway && (path.points().back() - motion.position).norm() > kAtEnd;
}

Vector3d openVelocity(const Motion& motion, const FlownPath& path, double speed, double yaw_rate,
                      const KeptRoom& room, const std::vector<Eigen::Vector3f>& moving,
                      const PilotOptions& options) {
  const double far = steersTo(motion);
  for (const double share : kShares)
    for (const double metres : {far, 0.5 * kSteerNear}) {
      const Vector3d direction = path.ahead(metres) - motion.position;
      const Vector3d velocity = velocityTowards(direction, share * speed, motion, options);
      if (stopsInOpen(motion, velocity, yaw_rate, room, moving, options)) return velocity;
    }
  return Vector3d::Zero();
}

}  // namespace

double angleDifference(double from, double to) {
  return std::remainder(to - from, 2.0 * M_PI);
}

double turnRate(double error, const PilotOptions& options) {
  return std::clamp(kTurnGain * error, -options.max_yaw_rate, options.max_yaw_rate);
}

Steering steerSafely(const Motion& motion, const FlownPath& path, const OpenSpace& space,
                     const std::vector<Eigen::Vector3f>& moving, const PilotOptions& options,
                     const std::optional<Vector3d>& look_at) {
  const KeptRoom room(space, options.d_safe, motion.position);
  const double tau = options.frame_period + options.response_time, top = options.max_speed;
  const double braking = top * tau + 0.5 * top * top / options.max_acceleration + kViewRoom;
  const FlownPath::Clear clear = path.clear(room, std::max(braking, kLookFar) + 0.2);
  Steering steering;
  steering.clear_path = clear.metres;
  steering.closed = clear.closed;
  steering.unseen = clear.closed && !space.seen(*clear.closed);
  const double yaw = look_at && !looksAlong(motion, path, options)
                         ? yawTo(*look_at, motion)
                         : wantedYaw(motion, path, clear, options);
  steering.look_error = angleDifference(motion.yaw, yaw);
  const double room_to_look = steering.unseen ? kViewRoom : 0.0;
  double speed = std::min(top, speedWithin(clear.metres - room_to_look, options));
  if (room.escapes()) speed = std::min(speed, kEscapeSpeed);
  double yaw_rate = turnRate(steering.look_error, options);
  Vector3d velocity = Vector3d::Zero();
  if (speed > 0.02) {
    velocity = openVelocity(motion, path, speed, yaw_rate, room, moving, options);
    steering.held = velocity.norm() < 0.01;
  }
  if (velocity.norm() < 0.01 && brakes(motion)) yaw_rate = 0.0;
  steering.velocity = inBody(velocity, motion.yaw, yaw_rate);
  return steering;
}

Steering steerAtFullSpeed(const Motion& motion, const FlownPath& path,
                          const PilotOptions& options) {
  Steering steering;
  const Vector3d direction = path.ahead(0.5 * options.step) - motion.position;
  steering.look_error = angleDifference(motion.yaw, yawTo(path.ahead(kLookNear), motion));
  const Vector3d velocity = velocityTowards(direction, options.max_speed, motion, options);
  steering.velocity = inBody(velocity, motion.yaw, turnRate(steering.look_error, options));
  return steering;
}

}  // namespace grid_path_planner::avoidance
