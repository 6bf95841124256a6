#include "planning/waypoints.h"

#include <algorithm>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "path/pose_spacing.h"
#include "planning/end_segments.h"

namespace grid_path_planner::planning {

using costmap::CostGrid, costmap::lineOfSight, costmap::SegmentPoint;
using path::applyHeadings, path::Path, path::Pose, path::spacedPoses;

namespace {

// Points that are this near to a line are on it, in metres.
constexpr double kOnLine = 1e-9;

class Thinning {
 public:
  Thinning(const Path& path, double tolerance, const CostGrid& costs)
      : poses_(path.poses), tolerance_(tolerance), costs_(costs), segments_(costs) {}

  // The first pose and, after each, the last that a straight line from it may lead to.
  std::vector<Pose> kept() const {
    const std::vector<std::size_t> corners = withoutStraightOnes();
    std::vector<Pose> kept = {poses_.front()};
    for (std::size_t i = 0; i + 1 < corners.size();) {
      std::size_t next = i + 1;
      while (next + 1 < corners.size() && replaced(corners[i], corners[next + 1])) ++next;
      i = next;
      kept.push_back(poses_[corners[i]]);
    }
    return kept;
  }

 private:
  Eigen::Vector2d at(std::size_t i) const { return poses_[i].position.head<2>(); }

  // Without the poses on the line from the corner before to the pose behind.
  std::vector<std::size_t> withoutStraightOnes() const {
    std::vector<std::size_t> corners = {0};
    for (std::size_t i = 1; i + 1 < poses_.size(); ++i)
      if (distance(i, corners.back(), i + 1) > kOnLine) corners.push_back(i);
    if (poses_.size() > 1) corners.push_back(poses_.size() - 1);
    return corners;
  }

  // Of pose i from the line between the other two.
  double distance(std::size_t i, std::size_t from, std::size_t to) const {
    const Eigen::Vector2d along = at(to) - at(from), towards = at(i) - at(from);
    const double squared = along.squaredNorm();
    const double share = squared > 0.0 ? std::clamp(along.dot(towards) / squared, 0.0, 1.0) : 0.0;
    return (towards - share * along).norm();
  }

  bool replaced(std::size_t from, std::size_t to) const {
    for (std::size_t i = from + 1; i < to; ++i)
      if (distance(i, from, to) > tolerance_) return false;
    return legal(at(from), at(to));
  }

  bool legal(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    if (segments_.measured()) return segments_.keeps(from, to);
    const auto point = [this](const Eigen::Vector2d& position) {
      return SegmentPoint::nearest(costs_.geometry().gridFromWorld(position));
    };
    return lineOfSight(costs_, point(from), point(to));
  }

  const std::vector<Pose>& poses_;
  const double tolerance_;
  const CostGrid& costs_;
  const EndSegments segments_;
};

}  // namespace

Path waypointsOf(const Path& path, const PlannerOptions& options, const CostGrid& costs) {
  if (path.poses.size() < 3 && options.waypoint_spacing <= 0.0) return path;
  Path waypoints = path;
  const double tolerance = options.min_turning_radius > 0.0 ? 0.0 : options.waypoint_tolerance;
  waypoints.poses = Thinning(path, tolerance, costs).kept();
  applyHeadings(waypoints, path.poses.front().yaw, path.poses.back().yaw, options.heading);
  return spacedPoses(waypoints, options.waypoint_spacing, options.heading);
}

}  // namespace grid_path_planner::planning
