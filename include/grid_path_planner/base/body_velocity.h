// A velocity in the vehicle's own frame, commanded or driven.
#pragma once

#include <Eigen/Core>
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

// The vector turned anticlockwise about z.
inline Eigen::Vector3d turned(const Eigen::Vector3d& v, double yaw) {
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

// The velocity of a vehicle with this heading, in the frame of the heading, and back.
inline Eigen::Vector3d inMap(const BodyVelocity& v, double yaw) {
  return turned({v.surge, v.sway, v.heave}, yaw);
}
inline BodyVelocity inBody(const Eigen::Vector3d& velocity, double yaw, double yaw_rate) {
  const Eigen::Vector3d v = turned(velocity, -yaw);
  return {v.x(), v.y(), v.z(), yaw_rate};
}

}  // namespace grid_path_planner::base
