#include "following/velocity_controller.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "following/omnidirectional_controller.h"
#include "following/wheeled_controller.h"
#include "vehicle/description.h"

namespace grid_path_planner::following {

using path::Pose;
using vehicle::Drive;

Steering Steering::slowed(double factor) const {
  Steering slower = *this;
  slower.command = {factor * command.surge, factor * command.sway, factor * command.heave,
                    factor * command.yaw_rate};
  slower.velocity *= factor;
  return slower;
}

Steering Steering::turnAlone() const {
  Steering turn = *this;
  turn.command = {0.0, 0.0, 0.0, command.yaw_rate};
  turn.velocity.setZero();
  return turn;
}

Steering Steering::withoutTurn() const {
  Steering straight = *this;
  straight.command.yaw_rate = 0.0;
  return straight;
}

void VelocityController::stop() {
  last_.command = {};
  last_.velocity.setZero();
  last_.turning = false;
}

Steering VelocityController::last(const Pose& vehicle) const {
  Steering last = last_;
  if (other_frame_)
    last.velocity =
        Eigen::AngleAxisd(vehicle.yaw - last_.yaw, Eigen::Vector3d::UnitZ()) * last_.velocity;
  return last;
}

double towards(double from, double to, double largest) {
  return from + std::clamp(to - from, -largest, largest);
}

double yawRateFor(double error, const FollowerOptions& options) {
  const double braking = std::sqrt(2.0 * 0.8 * options.max_yaw_acceleration * std::abs(error));
  const double fastest = std::min(options.max_yaw_rate, braking);
  return std::clamp(options.yaw_gain * error, -fastest, fastest);
}

std::unique_ptr<VelocityController> makeController(const FollowerOptions& options,
                                                   const vehicle::Description* vehicle) {
  if (vehicle && vehicle->drive != Drive::OMNIDIRECTIONAL)
    return std::make_unique<WheeledController>(options, *vehicle);
  return std::make_unique<OmnidirectionalController>(options, vehicle);
}

}  // namespace grid_path_planner::following
