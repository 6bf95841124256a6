// The projection of a camera: a pinhole with the lens distortion of sensor_msgs/CameraInfo.
//
//   checkCalibration(calibration);
//   const Eigen::Vector2d ideal = calibration.undistorted(corner);   // pixels of a lens without distortion
//
// The point x, y, z of the optical frame (REP 103: z ahead, x right, y down) is seen at column cx + fx x / z, row
// cy + fy y / z, before distortion; pixel (0, 0) has its centre at column 0, row 0.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace grid_path_planner::vision {

struct CameraCalibration {
  int width = 0;  // pixels
  int height = 0;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  // pixels
  std::vector<double> distortion;  // none, or plumb_bob's 5 or rational_polynomial's 8 coefficients

  // Where the point is seen without distortion (pixels); its z is positive.
  Eigen::Vector2d projected(const Eigen::Vector3d& point) const {
    return {cx + fx * point.x() / point.z(), cy + fy * point.y() / point.z()};
  }
  // Where a lens without distortion would have seen what this one sees at `pixel`.
  Eigen::Vector2d undistorted(const Eigen::Vector2d& pixel) const;
};

// Throws InputError for a calibration that is all zero, as of a camera that was not calibrated, not finite,
// without pixels, or with another number of coefficients.
void checkCalibration(const CameraCalibration& calibration);

// Throws InputError where an image of so many pixels is not the calibration's.
void checkSameSize(int width, int height, const CameraCalibration& calibration);

}  // namespace grid_path_planner::vision
