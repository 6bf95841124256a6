// What the rules `safe` keep about every point of a path: d_safe from points, and all of it seen.
//
// A vehicle that is nearer to a point or to what it has not seen than d_safe (noise, drift, a body that
// moved) may leave, but only so that this distance grows.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>

#include "avoidance/memory/open_space.h"

namespace grid_path_planner::avoidance {

class KeptRoom {
 public:
  KeptRoom(const OpenSpace& space, double d_safe, const Eigen::Vector3d& start)
      : space_(space),
        d_safe_(d_safe),
        start_(start),
        points_(space.nearest(start, d_safe)),
        start_seen_(space.seen(start)),
        unseen_(start_seen_ ? d_safe : space.nearestUnseen(start, d_safe)) {}

  bool open(const Eigen::Vector3d& point) const {
    if (!space_.inside(point)) return false;
    const double away = (point - start_).norm();
    if (space_.crowded(slotOf(voxelAt(point))) &&
        space_.nearest(point, d_safe_) < asked(points_, away))
      return false;
    if (space_.seen(point)) return true;
    return !start_seen_ &&
           space_.nearestUnseen(point, d_safe_) >= asked(unseen_ - kHalfVoxel, away);
  }
  // Whether the start itself is too near to something.
  bool escapes() const { return points_ < d_safe_ || !start_seen_; }

 private:
  double asked(double at_start, double away) const {
    return at_start < d_safe_ ? std::min(d_safe_, at_start - kNoise + kGrowth * away) : d_safe_;
  }

  static constexpr double kNoise = 0.02;     // m
  static constexpr double kHalfVoxel = 0.1;  // m, by which distances to voxels jump
  static constexpr double kGrowth = 0.2;     // m for each metre

  const OpenSpace& space_;
  double d_safe_;
  Eigen::Vector3d start_;
  double points_;
  bool start_seen_;
  double unseen_;
};

// The first of point_at(0) .. point_at(samples) that is not open, by its number; none: all are.
template <class PointAt>
std::optional<int> firstClosed(const KeptRoom& room, int samples, const PointAt& point_at) {
  for (int i = 0; i <= samples; ++i)
    if (!room.open(point_at(i))) return i;
  return std::nullopt;
}

}  // namespace grid_path_planner::avoidance
