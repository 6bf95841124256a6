#include "vision/camera_calibration.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::vision {

using base::InputError;

Eigen::Vector2d CameraCalibration::undistorted(const Eigen::Vector2d& pixel) const {
  if (distortion.empty()) return pixel;
  const cv::Matx33d matrix(fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0);
  std::vector<cv::Point2d> points = {{pixel.x(), pixel.y()}};
  cv::undistortPoints(points, points, matrix, distortion, cv::noArray(), matrix);
  return {points[0].x, points[0].y};
}

void checkCalibration(const CameraCalibration& c) {
  if (c.width < 1 || c.height < 1)
    throw InputError("the calibration is of an image of " + std::to_string(c.width) + " x " +
                     std::to_string(c.height) + " pixels");
  if (!(c.fx > 0.0 && c.fy > 0.0 && std::isfinite(c.fx + c.fy + c.cx + c.cy)))
    throw InputError("the camera is not calibrated: focal lengths must be positive numbers");
  const std::size_t count = c.distortion.size();
  if (count != 0 && count != 5 && count != 8)
    throw InputError("a lens has 0, 5 or 8 coefficients of distortion, got " +
                     std::to_string(count));
  for (const double coefficient : c.distortion)
    if (!std::isfinite(coefficient))
      throw InputError("a coefficient of distortion is not a finite number");
}

void checkSameSize(int width, int height, const CameraCalibration& c) {
  if (width != c.width || height != c.height)
    throw InputError("the image has " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels, the calibration " + std::to_string(c.width) + " x " +
                     std::to_string(c.height));
}

}  // namespace grid_path_planner::vision
