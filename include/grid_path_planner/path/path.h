// What a path is: poses in a frame.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace grid_path_planner::path {

// Metres and radians (anticlockwise about z).
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw = 0.0;
};

struct Path {
  std::string frame_id = "map";
  std::vector<Pose> poses;

  bool empty() const { return poses.empty(); }
};

}  // namespace grid_path_planner::path
