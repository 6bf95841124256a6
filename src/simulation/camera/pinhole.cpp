#include "simulation/camera/pinhole.h"

#include <cmath>

namespace grid_path_planner::simulation {

CameraIntrinsics intrinsicsOf(int width, int height, double horizontal_fov) {
  const double focal = 0.5 * width / std::tan(0.5 * horizontal_fov);
  return {focal, focal, 0.5 * (width - 1), 0.5 * (height - 1)};
}

Eigen::Vector3f rayThrough(const CameraIntrinsics& pinhole, double column, double row) {
  return Eigen::Vector3d((column - pinhole.cx) / pinhole.fx, (row - pinhole.cy) / pinhole.fy, 1.0)
      .normalized()
      .cast<float>();
}

std::vector<Eigen::Vector3f> raysOf(const CameraIntrinsics& pinhole, int width, int height) {
  std::vector<Eigen::Vector3f> rays;
  rays.reserve(static_cast<std::size_t>(width) * height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) rays.push_back(rayThrough(pinhole, column, row));
  return rays;
}

Eigen::Isometry3d opticalFrame() {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << 0.0, 0.0, 1.0,  // columns: right, down, ahead
      -1.0, 0.0, 0.0,               //
      0.0, -1.0, 0.0;
  return frame;
}

}  // namespace grid_path_planner::simulation
