// From the path to a velocity: as fast as the rules allow, looking where the path is not yet seen.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "avoidance/steering/braking.h"
#include "avoidance/steering/flown_path.h"
#include "grid_path_planner/base/body_velocity.h"

namespace grid_path_planner::avoidance {

struct Steering {
  base::BodyVelocity velocity = {};
  double clear_path = 0.0;                // m
  std::optional<Eigen::Vector3d> closed;  // where the path is not open
  double look_error = 0.0;                // rad, between where it looks and where it should
  bool unseen = false;                    // what closes it there was never seen
  bool held = false;  // the path is open, but no velocity along it stops in the open
};

// Under the rules `safe`; looks at `look_at`, if it is given, instead of along the path.
Steering steerSafely(const Motion& motion, const FlownPath& path, const OpenSpace& space,
                     const std::vector<Eigen::Vector3f>& moving, const PilotOptions& options,
                     const std::optional<Eigen::Vector3d>& look_at);
// Full speed along the path, whatever is seen.
Steering steerAtFullSpeed(const Motion& motion, const FlownPath& path, const PilotOptions& options);

// Whether a vehicle that is to stand must not turn yet: its velocity would turn with its body.
inline bool brakes(const Motion& motion) {
  return motion.velocity.norm() > 0.3;
}

// Rad/s that turn by `error`.
double turnRate(double error, const PilotOptions& options);
double angleDifference(double from, double to);

}  // namespace grid_path_planner::avoidance
