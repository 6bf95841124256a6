#include "panel/path_corners.h"

#include <Eigen/Geometry>

namespace grid_path_planner::panel {

using path::Path;
using path::Pose;

namespace {

constexpr double kStraight = 1e-6;  // m

// Whether `middle` lies on the line from `from` to `to`, not before or beyond them.
bool between(const Pose& from, const Pose& middle, const Pose& to) {
  const Eigen::Vector3d line = to.position - from.position, part = middle.position - from.position;
  const double length = line.norm(), along = length > 0.0 ? part.dot(line) / length : 0.0;
  if (length == 0.0 || along < 0.0 || along > length) return false;
  return (part - along / length * line).norm() <= kStraight;
}

}  // namespace

Path cornersOf(const Path& path) {
  Path corners;
  corners.frame_id = path.frame_id;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const bool end = i == 0 || i + 1 == path.poses.size();
    if (end || !between(corners.poses.back(), path.poses[i], path.poses[i + 1]))
      corners.poses.push_back(path.poses[i]);
  }
  return corners;
}

}  // namespace grid_path_planner::panel
