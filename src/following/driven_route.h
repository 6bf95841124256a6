// The polyline that is being driven: from the vehicle to the path, then the path's waypoints.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "grid_path_planner/following/follower_options.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::following {

// The difference of two angles, in [-pi, pi].
double angleBetween(double from, double to);

// m/s^2 that is planned with: a share of max_acceleration.
double brakingDeceleration(const FollowerOptions& options);

struct Knot {
  path::Pose pose;
  int waypoint = -1;  // index in the path; -1: a point that is no waypoint
  bool last = false;  // of the path, where it is not a loop
  bool stop = false;
  double s = 0.0;             // m, along the route
  double corner_speed = 0.0;  // m/s, with which it may be passed; 0 at a stop
  double speed_beyond = 0.0;  // m/s, with which it may be passed given the knots after it
  double stop_s = 0.0;        // m, along the route, of the next stop; infinite without one
};

class DrivenRoute {
 public:
  DrivenRoute() = default;
  // The knots with their pose, waypoint and last; the rest is computed, also by `update`.
  DrivenRoute(std::vector<Knot> knots, const FollowerOptions& options);
  void update(const FollowerOptions& options);

  const std::vector<Knot>& knots() const { return knots_; }
  std::size_t segments() const { return knots_.empty() ? 0 : knots_.size() - 1; }

  // Length of segment i, from knot i to knot i + 1, in metres.
  double length(std::size_t i) const { return knots_[i + 1].s - knots_[i].s; }
  // The share of the segment at the point of its line that is nearest to `position`: below 0 before
  // its start, above 1 beyond its end; 1 for a segment without length.
  double share(std::size_t i, const Eigen::Vector3d& position) const;
  Eigen::Vector3d point(std::size_t i, double share) const;
  // Metres from `position` to the segment.
  double distance(std::size_t i, const Eigen::Vector3d& position) const;
  // The segment after i that has a length; the last one, where none has.
  std::size_t next(std::size_t i) const;
  // Whether the route turns by more than a right angle at the end of segment i.
  bool turnsBack(std::size_t i) const;

  // The point `distance` metres beyond `share` of segment i, but not beyond a stop nor a turn of
  // more than a right angle.
  Eigen::Vector3d ahead(std::size_t i, double share, double distance) const;
  // The route from `share` of segment i on, `distance` metres of it.
  std::vector<Eigen::Vector3d> piece(std::size_t i, double share, double distance) const;
  // The speed with which the route may be driven there, for every corner and stop ahead.
  double speed(std::size_t i, double share, const FollowerOptions& options) const;

 private:
  Eigen::Vector3d direction(std::size_t i) const;
  Eigen::Vector3d at(double s) const;
  // The speed at which the vehicle may be `distance` metres before a knot, for it and the knots
  // after it.
  double speedBefore(std::size_t knot, double distance, const FollowerOptions& options) const;
  double cornerSpeed(std::size_t knot, const FollowerOptions& options) const;

  std::vector<Knot> knots_;
};

}  // namespace grid_path_planner::following
