// A motion of a vehicle between two poses: it drives straight from one to the other while its heading changes evenly, or turns
// on the spot.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "vehicle/footprint.h"

namespace grid_path_planner::vehicle {

// The heading changes evenly along the line.
struct Motion {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double yaw = 0.0;      // at `from`
  double turn = 0.0;     // to that at `to`, anticlockwise
  std::size_t pose = 0;  // of the path, at which it begins

  bool onTheSpot() const { return from == to; }
};

// The footprint's corners at a share of the motion, 0 to 1.
std::vector<Eigen::Vector2d> outlineAt(const Footprint& footprint, const Motion& motion,
                                       double share);

}  // namespace grid_path_planner::vehicle
