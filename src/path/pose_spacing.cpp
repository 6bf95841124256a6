#include "path/pose_spacing.h"

#include <algorithm>
#include <cmath>

#include "grid_path_planner/path/metrics.h"

namespace grid_path_planner::path {

namespace {

constexpr double kMostAdded = 1e6;
// Of a part's length: a segment of three cells has three parts, whatever its length was rounded to.
constexpr double kPartRounding = 1e-9;

}  // namespace

Path spacedPoses(const Path& path, double spacing, HeadingMode mode) {
  if (spacing <= 0.0 || path.empty()) return path;
  const double least = std::max(spacing, lengthOf(path) / kMostAdded);
  Path spaced;
  spaced.frame_id = path.frame_id;
  spaced.poses.push_back(path.poses.front());
  for (std::size_t i = 1; i < path.poses.size(); ++i) {
    const Pose &from = path.poses[i - 1], &to = path.poses[i];
    const double length = (to.position - from.position).head<2>().norm();
    const auto parts = static_cast<std::size_t>(std::ceil(length / least - kPartRounding));
    for (std::size_t part = 1; part < parts; ++part) {
      const double share = static_cast<double>(part) / static_cast<double>(parts);
      spaced.poses.push_back(from);
      spaced.poses.back().position += share * (to.position - from.position);
    }
    spaced.poses.push_back(to);
  }
  applyHeadings(spaced, path.poses.front().yaw, path.poses.back().yaw, mode);
  return spaced;
}

}  // namespace grid_path_planner::path
