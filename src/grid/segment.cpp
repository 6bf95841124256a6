#include "grid/segment.h"

#include <algorithm>

namespace grid_path_planner::grid {
namespace {

double distanceToSegment(const Eigen::Vector2d& point, const Segment& segment) {
  const Eigen::Vector2d along = segment.to - segment.from;
  const double length2 = along.squaredNorm();
  if (length2 == 0.0) return (point - segment.from).norm();
  const double t = std::clamp((point - segment.from).dot(along) / length2, 0.0, 1.0);
  return (point - segment.from - t * along).norm();
}

double distanceToBox(const Eigen::Vector2d& point, const Box& box) {
  return (point - point.cwiseMax(box.low).cwiseMin(box.high)).norm();
}

}  // namespace

// Liang and Barsky, 1984.
std::optional<Segment> clipped(const Segment& segment, const Box& box) {
  const Eigen::Vector2d along = segment.to - segment.from;
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0.0) {
      if (segment.from[axis] < box.low[axis] || segment.from[axis] > box.high[axis])
        return std::nullopt;
      continue;
    }
    const double t_low = (box.low[axis] - segment.from[axis]) / along[axis];
    const double t_high = (box.high[axis] - segment.from[axis]) / along[axis];
    enter = std::max(enter, std::min(t_low, t_high));
    leave = std::min(leave, std::max(t_low, t_high));
  }
  if (enter > leave) return std::nullopt;
  const auto at = [&](double t) -> Eigen::Vector2d {
    return (segment.from + t * along)
        .cwiseMax(box.low)
        .cwiseMin(box.high);  // whatever the rounding
  };
  return Segment{at(enter), at(leave)};
}

double distanceBetween(const Segment& segment, const Box& box) {
  if (clipped(segment, box)) return 0.0;
  double distance = std::min(distanceToBox(segment.from, box), distanceToBox(segment.to, box));
  for (const double x : {box.low.x(), box.high.x()})
    for (const double y : {box.low.y(), box.high.y()})
      distance = std::min(distance, distanceToSegment({x, y}, segment));
  return distance;
}

}  // namespace grid_path_planner::grid
