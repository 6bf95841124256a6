// A velocity in the vehicle's own frame, commanded or driven.
#pragma once

#include <cmath>

namespace grid_path_planner::base {

// In base_link (REP 103): x ahead, y to the left, z up, yaw anticlockwise seen from above.
struct BodyVelocity {
  double surge = 0.0;     // m/s, along x
  double sway = 0.0;      // m/s, along y
  double heave = 0.0;     // m/s, along z
  double yaw_rate = 0.0;  // rad/s, about z

  bool isZero() const { return surge == 0.0 && sway == 0.0 && heave == 0.0 && yaw_rate == 0.0; }
  bool isFinite() const {
    return std::isfinite(surge) && std::isfinite(sway) && std::isfinite(heave) &&
           std::isfinite(yaw_rate);
  }
};

}  // namespace grid_path_planner::base
