#include "avoidance/route.h"

#include <algorithm>

namespace grid_path_planner::avoidance {

using Eigen::Vector3d;

namespace {

constexpr double kCarrot = 5.0;   // m ahead on a path
constexpr double kPassing = 1.5;  // m, within which a point of a path is passed

}  // namespace

void Route::setWaypoints(const std::vector<Vector3d>& waypoints) {
  points_ = waypoints;
  is_path_ = false;
  index_ = 0;
}

void Route::setPath(const std::vector<Vector3d>& path) {
  setWaypoints(path);
  is_path_ = true;
}

int Route::index() const {
  return std::min(index_, static_cast<int>(points_.size()) - 1);
}

double Route::radius(const PilotOptions& options) const {
  return isLast() ? options.home_radius : options.arrival_radius;
}

std::optional<Vector3d> Route::after() const {
  if (isLast()) return std::nullopt;
  return points_[index_ + 1];
}

// A point of a path: near it, or nearer to the point after it than it is itself.
bool Route::passed(const Vector3d& vehicle) const {
  const Vector3d &here = points_[index_], &next = points_[index_ + 1];
  return (vehicle - here).norm() < kPassing || (vehicle - next).norm() < (here - next).norm();
}

void Route::advance(const Vector3d& vehicle, const PilotOptions& options) {
  while (is_path_ && !done() && !isLast() && passed(vehicle)) ++index_;
  if (!done() && (vehicle - points_[index_]).norm() <= radius(options)) ++index_;
}

Vector3d Route::target(const Vector3d& vehicle, const OpenSpace& space, double d_safe) const {
  if (!is_path_) return points_[index()];
  double ahead = (points_[index()] - vehicle).norm();
  for (int i = index(); i + 1 < static_cast<int>(points_.size()); ++i) {
    if (ahead >= kCarrot && space.nearest(points_[i], d_safe) >= d_safe) return points_[i];
    ahead += (points_[i + 1] - points_[i]).norm();
  }
  return points_.back();
}

}  // namespace grid_path_planner::avoidance
