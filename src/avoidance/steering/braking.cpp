#include "avoidance/steering/braking.h"

#include <algorithm>
#include <cmath>

#include "grid_path_planner/base/body_velocity.h"

namespace grid_path_planner::avoidance {
namespace {

using base::turned;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kTick = 0.05;      // s
constexpr double kBodySpeed = 1.0;  // m/s, of things that move
constexpr double kStands = 0.1;     // m/s
constexpr double kLongest = 30.0;   // s

Vector3d changed(Vector3d velocity, const Vector3d& target, double most) {
  for (int axis = 0; axis < 3; ++axis)
    velocity[axis] += std::clamp(target[axis] - velocity[axis], -most, most);
  return velocity;
}

bool keepsFromMoving(const Vector3d& point, double time, double d_safe,
                     const std::vector<Vector3f>& moving) {
  const double distance = d_safe + kBodySpeed * time;
  return std::none_of(moving.begin(), moving.end(), [&](const Vector3f& body) {
    return (body.cast<double>() - point).squaredNorm() < distance * distance;
  });
}

}  // namespace

bool stopsInOpen(const Motion& motion, const Vector3d& command, double yaw_rate,
                 const KeptRoom& room, const std::vector<Vector3f>& moving,
                 const PilotOptions& options) {
  const double change_from = options.response_time;
  const double change_to = change_from + std::max(kTick, options.frame_period);
  const double brake_from = change_to + options.response_time;
  const double most = options.max_acceleration * kTick;
  const Vector3d target = turned(command, -motion.yaw);
  Vector3d position = motion.position, velocity = turned(motion.velocity, -motion.yaw);
  double yaw = motion.yaw;
  for (double time = 0.0; time < kLongest; time += kTick) {
    const Vector3d before = velocity;
    if (time >= brake_from)
      velocity = changed(velocity, Vector3d::Zero(), most);
    else if (time >= change_from && time < change_to)
      velocity = changed(velocity, target, most);
    if (time < brake_from) yaw += kTick * (time < change_from ? motion.yaw_rate : yaw_rate);
    position += turned(0.5 * kTick * (before + velocity), yaw);
    if (!room.open(position)) return false;
    if (velocity.norm() > kStands && !keepsFromMoving(position, time, options.d_safe, moving))
      return false;
    if (time >= brake_from && velocity.norm() < 1e-6) return true;
  }
  return false;
}

double speedWithin(double metres, const PilotOptions& options) {
  if (metres <= 0.0) return 0.0;
  const double a = options.max_acceleration;
  const double lag = a * (options.frame_period + options.response_time);
  return std::sqrt(lag * lag + 2.0 * a * metres) - lag;
}

}  // namespace grid_path_planner::avoidance
