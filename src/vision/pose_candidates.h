// The poses that the corners of markers admit.
//
// Four corners of a square admit two poses: the square tilted to one side or the other looks nearly alike (Collins
// and Bartoli, "Infinitesimal Plane-Based Pose Estimation", 2014). Where both fit, noise decides which fits
// better: taken by the better fit, a pose flips (AprilRobotics/apriltag#71, opencv#8813).
#pragma once

#include <vector>

#include "vision/camera_calibration.h"
#include "vision/pose_estimate.h"

namespace grid_path_planner::vision {

// Poses of the camera by one marker alone, the better fit first; mostly two, none of corners that are no square's.
std::vector<Eigen::Isometry3d> posesByOneMarker(const MarkerView& view, const MarkerLayout& layout,
                                                const CameraCalibration& calibration);

// The local minima of the reprojection error of all corners, the best fit first, each once: refined
// from the poses that each marker alone admits.
std::vector<PoseEstimate> jointPoses(const MarkerViews& views, const MarkerLayout& layout,
                                     const CameraCalibration& calibration, double pixel_noise);

// Whether the corners admit every pose between two, as those of one marker seen nearly from the front do: its
// tilt hardly changes what is seen of it. Then the covariance of none of `minima` says how far off it may be.
// A pose is admitted whose squared error is less than `limit` times `variance` (pixels^2) above the least.
bool admitPosesBetween(const MarkerViews& views, const MarkerLayout& layout,
                       const CameraCalibration& calibration,
                       const std::vector<PoseEstimate>& minima, double variance, double limit);

}  // namespace grid_path_planner::vision
