// The mean of the poses that several markers give, each alone: what was published of the DexROV trial. Which of
// a marker's two poses fits better decides alone, so that some are flipped and the mean with them; jointPoses()
// is better, this is for comparison.
#pragma once

#include <vector>

#include "vision/camera_calibration.h"
#include "vision/marker_pose_options.h"
#include "vision/pose_estimate.h"

namespace grid_path_planner::vision {

// The attitude whose sum of squared distances to all, as quaternions, is least, whatever their order and signs:
// the eigenvector of the sum of q q^T (Markley et al., "Averaging Quaternions", 2007). At least one.
Eigen::Quaterniond meanAttitude(const std::vector<Eigen::Quaterniond>& attitudes);

// One pose with the covariance that the options state; none where no marker gives one.
std::vector<PoseEstimate> meanPose(const MarkerViews& views, const MarkerLayout& layout,
                                   const CameraCalibration& calibration,
                                   const MarkerPoseOptions& options);

}  // namespace grid_path_planner::vision
