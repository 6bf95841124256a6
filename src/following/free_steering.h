// The steering along a route whose motion is free: the fast one, else one that follows the route more exactly, a slower one, or a
// turn alone.
#pragma once

#include <optional>
#include <string>

#include "following/velocity_controller.h"
#include "grid_path_planner/following/path_follower.h"

namespace grid_path_planner::following {

struct FreeSteering {
  std::optional<Steering> steering;  // none: nothing but a zero
  std::string problem;               // of the first that was tried; empty: it is free
};

FreeSteering freeSteering(const VelocityController& controller, const RoutePosition& position,
                          const path::Pose& vehicle, double seconds, const MotionCheck& check);

// The same, of a steering that is given: it, or a slower one.
FreeSteering freeSteering(const Steering& steering, const MotionCheck& check);

}  // namespace grid_path_planner::following
