// What a depth camera or a lidar saw at one moment.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <vector>

namespace grid_path_planner::avoidance {

// A larger frame is refused: the vehicle waits for its next command meanwhile.
constexpr std::size_t kMostPixels = std::size_t{1} << 22;

// The point x, y, z is seen at column cx + fx x / z, row cy + fy y / z, in pixels.
struct Pinhole {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;
};

// Points of a picture (organised) or of a sweep. In the sensor's frame, which is the optical one
// (REP 103: z ahead, x right, y down) where there is a pinhole; a point that is not finite is a
// pixel that measured nothing.
struct Frame {
  double time = 0.0;  // s, when it was taken
  Eigen::Isometry3d map_from_sensor = Eigen::Isometry3d::Identity();
  int width = 0;                   // pixels of a row
  int height = 1;                  // rows; 1: not organised
  std::vector<float> points = {};  // x, y, z (m) of width * height pixels, row by row
  // None: only measured rays tell what is free.
  std::optional<Pinhole> pinhole = {};
  int sensor = 0;  // which of several took it

  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  bool organised() const { return height > 1; }
};

}  // namespace grid_path_planner::avoidance
