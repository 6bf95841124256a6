#include "following/check_waypoints.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/path/waypoint_file.h"

namespace grid_path_planner::following {

using base::InputError;
using path::kLargestCoordinate;
using path::Path;
using path::Pose;

namespace {

[[noreturn]] void refuse(const Path& path, std::size_t index, const char* what, double value,
                         const std::string& expected) {
  std::ostringstream text;
  text << "waypoint " << index + 1 << " of " << path.poses.size() << ": " << what << " must be "
       << expected << ", got " << value;
  throw InputError(text.str());
}

void checkCoordinate(const Path& path, std::size_t index, const char* what, double value) {
  if (!std::isfinite(value)) refuse(path, index, what, value, "a finite number of metres");
  if (std::abs(value) > kLargestCoordinate)
    refuse(path, index, what, value, "below 1e6 m in magnitude");
}

}  // namespace

void checkWaypoints(const Path& path, bool loop) {
  if (path.empty()) throw InputError("a path to drive needs at least one waypoint, got none");
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const Pose& pose = path.poses[i];
    checkCoordinate(path, i, "x", pose.position.x());
    checkCoordinate(path, i, "y", pose.position.y());
    checkCoordinate(path, i, "z", pose.position.z());
    if (!std::isfinite(pose.yaw)) refuse(path, i, "yaw", pose.yaw, "a finite angle");
  }
  const Eigen::Vector3d& first = path.poses.front().position;
  if (loop && std::all_of(path.poses.begin(), path.poses.end(),
                          [&](const Pose& pose) { return pose.position == first; }))
    throw InputError("a loop needs waypoints in two different places");
}

}  // namespace grid_path_planner::following
