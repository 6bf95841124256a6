#include "path/clearance_meter.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "grid/segment.h"
#include "grid_path_planner/path/metrics.h"
#include "path/occupied_cells.h"
#include "path/straight_runs.h"

namespace grid_path_planner::path {

using grid::GridGeometry, grid::OccupancyGrid, grid::OccupancyThresholds, grid::Segment;

namespace {

constexpr double kNoObstacle = std::numeric_limits<double>::infinity();
constexpr double kFirstReach = 32.0;  // cells
constexpr double kSlack = OccupiedCells::kSlack;

// The least distance of a polyline to the occupied cells. Distances change along it no faster than it
// is long, so a piece between two points whose distances are known is never nearer than half of what
// they have together more than its length (Piyavskii, 1972): only what may be nearer than the least
// one so far is looked at, in halves.
class ClearanceSearch {
 public:
  ClearanceSearch(OccupiedCells& occupied, std::vector<Eigen::Vector2d> points)
      : occupied_(occupied), points_(std::move(points)), along_(points_.size(), 0.0) {
    for (std::size_t i = 1; i < points_.size(); ++i)
      along_[i] = along_[i - 1] + (points_[i] - points_[i - 1]).norm();
  }

  // In cells; infinity where no cell is occupied.
  double least() {
    const double first = least_ = occupied_.distanceTo(points_.front(), kNoObstacle);
    const std::size_t last = points_.size() - 1;
    if (last > 0 && least_ < kNoObstacle)
      lowerBetween(0, last, first, distanceTo(last, along_[last]));
    return least_;
  }

 private:
  // Of a point, as far as a piece of this length beside it asks for it: or some less.
  double distanceTo(std::size_t i, double length) {
    const double reach = least_ + std::min(length, std::max(least_, kFirstReach)) + kSlack;
    const double distance = occupied_.distanceTo(points_[i], reach);
    least_ = std::min(least_, distance);
    return distance;
  }

  void lowerBetween(std::size_t i, std::size_t j, double at_i, double at_j) {
    const double length = along_[j] - along_[i];
    if (0.5 * (at_i + at_j - length) >= least_ + kSlack) return;
    if (j == i + 1) {
      least_ = occupied_.distanceTo(Segment{points_[i], points_[j]}, least_);
      return;
    }
    const std::size_t middle = i + (j - i) / 2;
    const double at_middle = distanceTo(middle, 0.5 * length);
    if (at_i < at_j) {
      lowerBetween(i, middle, at_i, at_middle);
      lowerBetween(middle, j, at_middle, at_j);
    } else {
      lowerBetween(middle, j, at_middle, at_j);
      lowerBetween(i, middle, at_i, at_middle);
    }
  }

  OccupiedCells& occupied_;
  const std::vector<Eigen::Vector2d> points_;
  std::vector<double> along_;  // the polyline, to each point
  double least_ = kNoObstacle;
};

}  // namespace

ClearanceMeter::ClearanceMeter(std::shared_ptr<const OccupancyGrid> map,
                               const OccupancyThresholds& thresholds)
    : map_(std::move(map)), thresholds_(thresholds), occupied_(*map_, thresholds) {}

bool ClearanceMeter::isOf(const std::shared_ptr<const OccupancyGrid>& map,
                          const OccupancyThresholds& thresholds) const {
  return isOfMap(map) && thresholds.free_max == thresholds_.free_max &&
         thresholds.occupied_min == thresholds_.occupied_min;
}

double ClearanceMeter::clearanceOf(const Path& path) {
  const GridGeometry& geometry = map_->geometry();
  if (path.empty() || geometry.size() == 0) return kNoObstacle;
  std::vector<Eigen::Vector2d> points;
  points.reserve(path.poses.size());
  for (const Pose& pose : path.poses)
    points.push_back(geometry.gridFromWorld(pose.position.head<2>()));
  return ClearanceSearch(occupied_, withoutCollinearPoints(points, kFirstReach)).least() *
         geometry.resolution();
}

double clearanceOf(const Path& path, const OccupancyGrid& map,
                   const OccupancyThresholds& thresholds) {
  const std::shared_ptr<const OccupancyGrid> not_owned(std::shared_ptr<void>(), &map);
  return ClearanceMeter(not_owned, thresholds).clearanceOf(path);
}

}  // namespace grid_path_planner::path
