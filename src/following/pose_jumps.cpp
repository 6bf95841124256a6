#include "following/pose_jumps.h"

#include <cmath>
#include <utility>

#include "following/driven_route.h"

namespace grid_path_planner::following {

using path::Pose;

namespace {

constexpr double kFaster = 1.5;   // than the limits, of a vehicle that something pushes
constexpr double kYawJump = 0.5;  // rad
constexpr double kSlowest = 0.5;  // m/s and rad/s that something pushes in any case

}  // namespace

std::optional<double> PoseJumps::note(const Pose& pose, double time,
                                      const FollowerOptions& options) {
  if (last_ && time <= last_->time) return std::nullopt;  // no newer pose
  const std::optional<Stamped> before = std::exchange(last_, Stamped{pose, time});
  if (!before || options.pose_jump <= 0.0) return std::nullopt;
  const double moved = (pose.position - before->pose.position).norm();
  const double turned = std::abs(angleBetween(before->pose.yaw, pose.yaw));
  const double seconds = time - before->time;
  const double driven =
      (kSlowest + kFaster * std::hypot(options.max_speed, options.max_vertical_speed)) * seconds;
  const double rotated = (kSlowest + kFaster * options.max_yaw_rate) * seconds;
  if (moved <= options.pose_jump + driven && turned <= kYawJump + rotated) return std::nullopt;
  return moved;
}

}  // namespace grid_path_planner::following
