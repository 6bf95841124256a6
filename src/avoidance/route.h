// What the pilot flies to: waypoints that it must reach, or a path along which it goes.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "avoidance/memory/open_space.h"
#include "grid_path_planner/avoidance/pilot_options.h"

namespace grid_path_planner::avoidance {

class Route {
 public:
  void setWaypoints(const std::vector<Eigen::Vector3d>& waypoints);
  void setPath(const std::vector<Eigen::Vector3d>& path);
  bool empty() const { return points_.empty(); }

  // Passes what is reached from here.
  void advance(const Eigen::Vector3d& vehicle, const PilotOptions& options);
  bool done() const { return index_ >= static_cast<int>(points_.size()); }
  // Of the waypoint that is flown to; the last one where all are reached.
  int index() const;

  // Where to fly now: the waypoint, or the first point of the path some metres ahead that is not occupied.
  Eigen::Vector3d target(const Eigen::Vector3d& vehicle, const OpenSpace& space,
                         double d_safe) const;
  // How near it must come, and where it goes on then.
  double radius(const PilotOptions& options) const;
  std::optional<Eigen::Vector3d> after() const;
  const Eigen::Vector3d& goal() const { return points_[index()]; }

 private:
  bool isLast() const { return index_ + 1 >= static_cast<int>(points_.size()); }
  bool passed(const Eigen::Vector3d& vehicle) const;

  std::vector<Eigen::Vector3d> points_;
  bool is_path_ = false;
  int index_ = 0;
};

}  // namespace grid_path_planner::avoidance
