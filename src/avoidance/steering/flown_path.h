// The path that is flown: what of it is still ahead, how much of that is open, and where to look.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "avoidance/steering/kept_room.h"

namespace grid_path_planner::avoidance {

class FlownPath {
 public:
  // From the vehicle on; `beyond` is where the flight goes on after the path's end.
  void set(std::vector<Eigen::Vector3d> points, std::optional<Eigen::Vector3d> beyond);
  void clear();
  bool empty() const { return points_.size() < 2; }
  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  // Another number after every set() and clear() that changed it.
  int revision() const { return revision_; }

  // The vehicle is here: what lies behind it is dropped, and the path begins at it.
  void advance(const Eigen::Vector3d& vehicle);

  // The point `metres` ahead on the path and on what lies beyond; the end where it is shorter.
  Eigen::Vector3d ahead(double metres) const;

  struct Clear {
    double metres = 0.0;                    // from the vehicle on
    std::optional<Eigen::Vector3d> closed;  // the first point that is not open
  };
  // Looked for up to `longest` metres ahead.
  Clear clear(const KeptRoom& room, double longest) const;

 private:
  std::vector<Eigen::Vector3d> points_;
  std::optional<Eigen::Vector3d> beyond_;
  int revision_ = 0;
};

}  // namespace grid_path_planner::avoidance
