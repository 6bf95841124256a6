#include "grid_path_planner/planning/replan_policy.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "path/straight_runs.h"
#include "planning/end_segments.h"

namespace grid_path_planner::planning {

using costmap::CostGrid, costmap::KeptDistances, costmap::lineCost, costmap::lineOfSight,
    costmap::SegmentPoint;
using grid::GridGeometry;
using path::Path, path::Pose, path::withoutCollinearPoints;

namespace {

constexpr std::size_t kFromStart = 2;       // segments from where a vehicle is
constexpr double kMeasuredTogether = 32.0;  // cells of a straight run

Polyline polylineOf(const Path& path) {
  Polyline line;
  for (const Pose& pose : path.poses) line.push_back(pose.position.head<2>());
  return line;
}

Eigen::Vector2d nearestOnSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                 const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = b - a;
  const double squared = along.squaredNorm();
  if (squared == 0.0) return a;
  return a + along * std::clamp(along.dot(point - a) / squared, 0.0, 1.0);
}

bool sameEnd(const Path& a, const Path& b) {
  const Pose& one = a.poses.back();
  const Pose& other = b.poses.back();
  return (one.position - other.position).norm() < 1e-6 && std::abs(one.yaw - other.yaw) < 1e-6;
}

// The points of a path and of what remains of it need not be centres, so the distances are measured.
// The first two segments lead from where the vehicle is, which may be nearer, to the path and along
// it.
bool keepsDistances(const Polyline& line, const CostGrid& costs) {
  const EndSegments segments(costs);
  const KeptDistances at_start = segments.at(line.front());
  for (std::size_t i = 0; i + 1 < line.size() && i < kFromStart; ++i)
    if (!segments.leavesStart(line[i], line[i + 1], at_start)) return false;
  if (line.size() <= kFromStart) return true;
  const Polyline rest = withoutCollinearPoints({line.begin() + kFromStart, line.end()},
                                               kMeasuredTogether * costs.geometry().resolution());
  for (std::size_t i = 0; i + 1 < rest.size(); ++i)
    if (!segments.keeps(rest[i], rest[i + 1])) return false;
  return true;
}

}  // namespace

Polyline remainingPath(const Path& path, const Eigen::Vector2d& position) {
  const Polyline line = polylineOf(path);
  if (line.size() < 2) return {position, line.empty() ? position : line.back()};
  std::size_t nearest_segment = 0;
  Eigen::Vector2d nearest = line.front();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector2d point = nearestOnSegment(line[i], line[i + 1], position);
    const double distance = (point - position).squaredNorm();
    if (distance > least) continue;
    least = distance;
    nearest = point;
    nearest_segment = i;
  }
  Polyline remaining = {position, nearest};
  remaining.insert(remaining.end(), line.begin() + nearest_segment + 1, line.end());
  return remaining;
}

std::optional<double> costOf(const Polyline& line, const CostGrid& costs) {
  const GridGeometry& geometry = costs.geometry();
  for (const Eigen::Vector2d& point : line)
    if (!geometry.cellAt(point)) return std::nullopt;
  if (EndSegments(costs).measured() && !keepsDistances(line, costs)) return std::nullopt;
  double cost = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const SegmentPoint from = SegmentPoint::nearest(geometry.gridFromWorld(line[i]));
    const SegmentPoint to = SegmentPoint::nearest(geometry.gridFromWorld(line[i + 1]));
    if (!EndSegments(costs).measured() && !lineOfSight(costs, from, to)) return std::nullopt;
    cost += lineCost(costs, from, to);
  }
  return cost;
}

bool pathBlocked(const Path& path, const std::optional<Eigen::Vector2d>& position,
                 const CostGrid& costs) {
  return !costOf(position ? remainingPath(path, *position) : polylineOf(path), costs);
}

bool keepsPath(const Path& old, const Path& fresh, const CostGrid& costs, double hysteresis) {
  if (old.empty() || fresh.empty() || !sameEnd(old, fresh)) return false;
  const auto old_cost = costOf(remainingPath(old, fresh.poses.front().position.head<2>()), costs);
  if (!old_cost) return false;
  const auto fresh_cost = costOf(polylineOf(fresh), costs);
  return fresh_cost && *old_cost <= (1.0 + hysteresis) * *fresh_cost;
}

}  // namespace grid_path_planner::planning
