#include "seen_map/seen_map.h"

#include <cmath>

#include "grid_path_planner/mapping/projection.h"
#include "grid_path_planner/planning/path_planner.h"

namespace grid_path_planner::seen_map {

using avoidance::Frame, avoidance::PilotOptions;
using Eigen::Vector3d, Eigen::Vector3f;
using mapping::OctreeOptions, mapping::Projection, mapping::ProjectionOptions, mapping::Scan,
    mapping::treePoint;
using planning::PathPlanner, planning::Plan, planning::PlannerOptions;

namespace {

constexpr double kKeepEvery = 0.45;  // s
constexpr std::size_t kMostWaiting = 100;
constexpr int kStride = 4;               // pixels
constexpr double kFarthestPlan = 300.0;  // m, to goals that are planned to
constexpr double kHalfBand = 0.3;        // m above and below the vehicle's middle
constexpr int kUnknownWeight = 3;        // of a cell length through what was not seen

OctreeOptions octreeOptions(const PilotOptions& pilot) {
  OctreeOptions options;
  options.resolution = 0.2;
  options.max_range = pilot.range_max;
  return options;
}

PlannerOptions plannerOptions(const PilotOptions& pilot) {
  PlannerOptions options;
  options.costmap.radius = pilot.d_safe;
  options.costmap.unknown_weight = kUnknownWeight;
  options.costmap.radius_to_unknown = 0.0;
  options.costmap.outside = costmap::Outside::FREE;
  options.tolerance = 3.0;
  options.start_escape_radius = 2.0;
  options.smooth = true;
  options.timeout = 0.0;  // its answer must not depend on a clock
  return options;
}

bool measuredAt(const Frame& frame, int column, int row) {
  return std::isfinite(frame.points[3 * static_cast<std::size_t>(row * frame.width + column)]);
}

bool emptyAround(const Frame& frame, int column, int row) {
  for (int r = std::max(0, row - 1); r <= std::min(frame.height - 1, row + 1); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(frame.width - 1, column + 1); ++c)
      if (measuredAt(frame, c, r)) return false;
  return true;
}

}  // namespace

SeenMap::SeenMap(const PilotOptions& options) : options_(options), map_(octreeOptions(options)) {}

void SeenMap::see(const Frame& frame) {
  const auto kept = kept_at_.find(frame.sensor);
  if (kept != kept_at_.end() && frame.time - kept->second < kKeepEvery) return;
  kept_at_[frame.sensor] = frame.time;
  waiting_.push_back(scanOf(frame));
  if (waiting_.size() >= kMostWaiting) insertWaiting();
}

void SeenMap::insertWaiting() {
  for (const Scan& scan : waiting_) map_.insert(scan);
  waiting_.clear();
}

Scan SeenMap::scanOf(const Frame& frame) const {
  Scan scan;
  scan.origin = treePoint(frame.map_from_sensor.translation());
  for (int row = 0; row < frame.height; row += kStride)
    for (int column = 0; column < frame.width; column += kStride) {
      const Vector3f point(&frame.points[3 * static_cast<std::size_t>(row * frame.width + column)]);
      if (point.allFinite()) {
        scan.hits.push_back(treePoint(frame.map_from_sensor * point.cast<double>()));
      } else if (options_.no_return_clears > 0.0 && frame.pinhole &&
                 emptyAround(frame, column, row)) {
        const Vector3d ray((column - frame.pinhole->cx) / frame.pinhole->fx,
                           (row - frame.pinhole->cy) / frame.pinhole->fy, 1.0);
        scan.clear_only.push_back(
            treePoint(frame.map_from_sensor * (options_.no_return_clears * ray.normalized())));
      }
    }
  return scan;
}

std::vector<Vector3d> SeenMap::plan(const Vector3d& from, const Vector3d& goal,
                                    const base::StopSource& stop) {
  insertWaiting();
  if ((goal - from).norm() > kFarthestPlan) return {};
  ProjectionOptions band;
  band.min_z = from.z() - kHalfBand;
  band.max_z = from.z() + kHalfBand;
  const Eigen::Vector2d low = from.head<2>().cwiseMin(goal.head<2>()).array() - 25.0;
  const Eigen::Vector2d high = from.head<2>().cwiseMax(goal.head<2>()).array() + 25.0;
  band.bounds = {low.x(), low.y(), high.x(), high.y()};
  Projection projection(map_.options().resolution, band);
  projection.update(map_.bricks());
  PathPlanner planner(plannerOptions(options_));
  planner.setMap(std::make_shared<const grid::OccupancyGrid>(projection.grid()));
  planning::PoseRequest request;
  request.start.position = from;
  request.goal.position = goal;
  const Plan found = planner.plan(request, stop);
  std::vector<Vector3d> path;
  for (const auto& pose : found.path.poses) path.push_back(pose.position);
  return path;
}

}  // namespace grid_path_planner::seen_map
