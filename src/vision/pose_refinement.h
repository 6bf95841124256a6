// The pose that fits all corners best: Levenberg-Marquardt on the reprojection error, from a start.
//
//   const PoseEstimate pose = refined(views, calibration, start, 0.3);
//
// Minimised is the sum of squared distances (pixels) between seen and projected corners. The covariance is
// (J^T J)^-1 times the larger of the assumed variance and that which the residuals show, with 2 * 4 * markers - 6
// degrees of freedom. The sum is infinite where a corner would be behind the camera.
#pragma once

#include "vision/camera_calibration.h"
#include "vision/pose_estimate.h"

namespace grid_path_planner::vision {

// `pixel_noise` is the assumed standard deviation of a corner's coordinate. A squared error that is not
// finite: there is no such pose near `start`.
PoseEstimate refined(const MarkerViews& views, const CameraCalibration& calibration,
                     const Eigen::Isometry3d& start, double pixel_noise);

// The variance of a corner's coordinate (pixels^2), assumed or found.
double varianceOf(const PoseEstimate& pose, std::size_t markers, double pixel_noise);

// Sum over all corners of the squared distance (pixels^2) of where they are seen from where `pose` has them;
// infinite where one would be behind the camera.
double squaredErrorOf(const MarkerViews& views, const CameraCalibration& calibration,
                      const Eigen::Isometry3d& panel_from_camera);

}  // namespace grid_path_planner::vision
