// Whether a vehicle goes sideways as it is commanded. One with two wheels does not, whatever linear.y says.
#pragma once

#include <optional>

#include "grid_path_planner/path/path.h"

namespace grid_path_planner::following {

class SwayCheck {
 public:
  // `sway` (m/s) was commanded from the last pose to this one, for so many seconds. False once it was commanded for
  // two seconds and the vehicle hardly went so.
  bool follows(const path::Pose& vehicle, double sway, double seconds);
  void restart() { *this = {}; }

 private:
  std::optional<path::Pose> last_;
  double seconds_ = 0.0;    // in which it was commanded
  double commanded_ = 0.0;  // m
  double driven_ = 0.0;     // m, in the direction that was commanded
};

}  // namespace grid_path_planner::following
