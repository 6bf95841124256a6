#include "following/go_to/driven_track.h"

#include <cmath>

namespace grid_path_planner::following {

using path::Path;
using path::Pose;

namespace {

double metresApart(const Pose& a, const Pose& b) {
  return (a.position - b.position).norm();
}

}  // namespace

void DrivenTrack::add(const Pose& pose) {
  if (!pose.position.allFinite() || !std::isfinite(pose.yaw)) return;
  if (!poses_.empty()) {
    const double moved = metresApart(poses_.back(), pose);
    if (moved < kSpacing) return;
    if (moved > kJump) poses_.clear();
  }
  poses_.push_back(pose);
  if (static_cast<double>(poses_.size()) * kSpacing > kLongest) poses_.pop_front();
}

Path DrivenTrack::back(const Pose& from, double length) const {
  Path path;
  double left = length;
  const Pose* before = &from;
  for (auto pose = poses_.rbegin(); pose != poses_.rend() && left > 0.0; ++pose) {
    left -= metresApart(*before, *pose);
    path.poses.push_back(*pose);
    before = &*pose;
  }
  const bool long_enough = !path.empty() &&
                           metresApart(from, path.poses.back()) >= 0.5 * kSpacing &&
                           length - left >= kSpacing;
  return long_enough ? path : Path();
}

}  // namespace grid_path_planner::following
