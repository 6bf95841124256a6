// A pose on the ground, for tests of the panel.
#pragma once

#include "grid_path_planner/path/path.h"

namespace grid_path_planner::test {

inline path::Pose poseAt(double x, double y) {
  path::Pose pose;
  pose.position = {x, y, 0.0};
  return pose;
}

}  // namespace grid_path_planner::test
