// A pose of a camera before a panel, and how well it is known.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "vision/grey_image.h"
#include "vision/marker_layout.h"

namespace grid_path_planner::vision {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Chi squared with 6 degrees of freedom at 0.999: what is farther off, in variances, is something else.
constexpr double kPoseGate = 22.46;

// A marker of the layout as it was seen.
struct MarkerView {
  int id = 0;
  Corners points;        // m, in the panel's frame
  PixelCorners corners;  // undistorted
};

using MarkerViews = std::vector<MarkerView>;

struct PoseEstimate {
  Eigen::Isometry3d panel_from_camera = Eigen::Isometry3d::Identity();  // of the optical frame
  // Of the position in the panel's frame (m), then of the right error of the attitude, R Exp(error), in the
  // camera's (rad).
  Matrix6 covariance = Matrix6::Zero();
  double squared_error = 0.0;  // pixels^2, the sum over all corners
};

// Of the product v x ...
inline Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d cross;
  cross << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return cross;
}

// What `other` is off from `pose`, in the coordinates of PoseEstimate::covariance.
inline Vector6 differenceOf(const Eigen::Isometry3d& other, const Eigen::Isometry3d& pose) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(pose.linear().transpose() * other.linear()));
  Vector6 difference;
  difference << other.translation() - pose.translation(), turn.angle() * turn.axis();
  return difference;
}

}  // namespace grid_path_planner::vision
