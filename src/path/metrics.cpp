#include "grid_path_planner/path/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "path/segment.h"

namespace grid_path_planner::path {

using grid::Cell, grid::CellRect, grid::GridGeometry, grid::Occupancy, grid::OccupancyGrid,
    grid::OccupancyThresholds;

namespace {

constexpr double kNoObstacle = std::numeric_limits<double>::infinity();

// How many cells of any rectangle of a map are occupied, by sums over all rectangles from the
// corner.
class OccupiedCount {
 public:
  OccupiedCount(const OccupancyGrid& map, const OccupancyThresholds& thresholds)
      : stride_(map.width() + 1), sums_(stride_ * (map.height() + 1), 0) {
    for (int row = 0; row < map.height(); ++row) {
      std::uint32_t in_row = 0;
      for (int column = 0; column < map.width(); ++column) {
        in_row += thresholds.classify(map[Cell{column, row}]) == Occupancy::OCCUPIED;
        sums_[(row + 1) * stride_ + column + 1] = sums_[row * stride_ + column + 1] + in_row;
      }
    }
  }

  // Precondition: the rectangle lies in the map.
  bool anyIn(const CellRect& rect) const {
    const std::size_t top = (rect.row + rect.height) * stride_, bottom = rect.row * stride_;
    const std::size_t right = rect.column + rect.width, left = rect.column;
    return sums_[top + right] - sums_[top + left] != sums_[bottom + right] - sums_[bottom + left];
  }

 private:
  std::size_t stride_;
  std::vector<std::uint32_t> sums_;
};

Box boxOf(const CellRect& rect) {
  const Eigen::Vector2d low(rect.column, rect.row);
  return {low, low + Eigen::Vector2d(rect.width, rect.height)};
}

std::pair<CellRect, CellRect> halves(const CellRect& rect) {
  CellRect first = rect, second = rect;
  if (rect.width >= rect.height) {
    first.width = rect.width / 2;
    second.column += first.width;
    second.width -= first.width;
  } else {
    first.height = rect.height / 2;
    second.row += first.height;
    second.height -= first.height;
  }
  return {first, second};
}

// Lowers `least` to the distance from the segment to the nearest occupied cell of `rect`, in cells:
// branch and bound, the nearer half first.
void lowerToNearest(const Segment& segment, const CellRect& rect, double distance,
                    const OccupiedCount& occupied, double& least) {
  if (distance >= least || !occupied.anyIn(rect)) return;
  if (rect.width == 1 && rect.height == 1) {
    least = distance;
    return;
  }
  auto [near, far] = halves(rect);
  double near_distance = distanceBetween(segment, boxOf(near));
  double far_distance = distanceBetween(segment, boxOf(far));
  if (far_distance < near_distance) {
    std::swap(near, far);
    std::swap(near_distance, far_distance);
  }
  lowerToNearest(segment, near, near_distance, occupied, least);
  lowerToNearest(segment, far, far_distance, occupied, least);
}

}  // namespace

double lengthOf(const Path& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.poses.size(); ++i)
    length += (path.poses[i].position - path.poses[i - 1].position).head<2>().norm();
  return length;
}

double turningOf(const Path& path) {
  double turning = 0.0;
  Eigen::Vector2d before = Eigen::Vector2d::Zero();
  for (std::size_t i = 1; i < path.poses.size(); ++i) {
    const Eigen::Vector2d now = (path.poses[i].position - path.poses[i - 1].position).head<2>();
    if (now.isZero(0.0)) continue;
    const double cross = before.x() * now.y() - before.y() * now.x();
    if (!before.isZero(0.0)) turning += std::abs(std::atan2(cross, before.dot(now)));
    before = now;
  }
  return turning;
}

double clearanceOf(const Path& path, const OccupancyGrid& map,
                   const OccupancyThresholds& thresholds) {
  const GridGeometry& geometry = map.geometry();
  if (path.empty() || geometry.size() == 0) return kNoObstacle;
  const OccupiedCount occupied(map, thresholds);
  double least = kNoObstacle;
  Eigen::Vector2d from = geometry.gridFromWorld(path.poses[0].position.head<2>());
  for (const Pose& pose : path.poses) {
    const Eigen::Vector2d to = geometry.gridFromWorld(pose.position.head<2>());
    lowerToNearest({from, to}, geometry.rect(), 0.0, occupied, least);
    from = to;
  }
  return least * geometry.resolution();
}

}  // namespace grid_path_planner::path
