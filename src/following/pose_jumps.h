// Whether a vehicle's pose changes faster than the vehicle can move: its localiser has found out that it is elsewhere.
#pragma once

#include <optional>

#include "grid_path_planner/following/follower_options.h"
#include "grid_path_planner/path/path.h"

namespace grid_path_planner::following {

class PoseJumps {
 public:
  // Metres between the pose and the last, where that is a jump: beyond pose_jump and what the vehicle drives meanwhile. A turn
  // of more than half a radian beyond what it turns meanwhile is one too.
  // `time`: of the pose, in seconds.
  std::optional<double> note(const path::Pose& pose, double time, const FollowerOptions& options);
  // The next pose is compared with none.
  void forget() { last_.reset(); }

 private:
  struct Stamped {
    path::Pose pose;
    double time;
  };

  std::optional<Stamped> last_;
};

}  // namespace grid_path_planner::following
