#include "following/sway_check.h"

#include <cmath>
#include <utility>

namespace grid_path_planner::following {

using path::Pose;

namespace {

constexpr double kSlow = 0.03;      // m/s: less is no command
constexpr double kWindow = 2.0;     // s
constexpr double kDistance = 0.1;   // m
constexpr double kFollowed = 0.25;  // share of what was commanded

}  // namespace

bool SwayCheck::follows(const Pose& vehicle, double sway, double seconds) {
  const std::optional<Pose> before = std::exchange(last_, vehicle);
  if (!before || std::abs(sway) < kSlow) return true;
  const Eigen::Vector3d moved = vehicle.position - before->position;
  const double left = std::cos(before->yaw) * moved.y() - std::sin(before->yaw) * moved.x();
  seconds_ += seconds;
  commanded_ += std::abs(sway) * seconds;
  driven_ += std::copysign(left, left * sway);
  if (seconds_ < kWindow || commanded_ < kDistance) return true;
  const bool follows = driven_ >= kFollowed * commanded_;
  restart();
  last_ = vehicle;
  return follows;
}

}  // namespace grid_path_planner::following
