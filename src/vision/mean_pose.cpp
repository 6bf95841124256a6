#include "vision/mean_pose.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "vision/pose_candidates.h"
#include "vision/pose_refinement.h"

namespace grid_path_planner::vision {

Eigen::Quaterniond meanAttitude(const std::vector<Eigen::Quaterniond>& attitudes) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const Eigen::Quaterniond& q : attitudes) sum += q.coeffs() * q.coeffs().transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(sum);
  return Eigen::Quaterniond(Eigen::Vector4d(solver.eigenvectors().col(3)));  // of the largest
}

std::vector<PoseEstimate> meanPose(const MarkerViews& views, const MarkerLayout& layout,
                                   const CameraCalibration& calibration,
                                   const MarkerPoseOptions& options) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::vector<Eigen::Quaterniond> attitudes;
  PoseEstimate mean;
  for (const MarkerView& view : views) {
    const auto poses = jointPoses({view}, layout, calibration, options.pixel_noise);
    if (poses.empty()) continue;
    sum += poses.front().panel_from_camera.translation();
    attitudes.emplace_back(poses.front().panel_from_camera.rotation());
  }
  if (attitudes.empty()) return {};
  mean.panel_from_camera =
      Eigen::Translation3d(sum / static_cast<double>(attitudes.size())) * meanAttitude(attitudes);
  mean.squared_error = squaredErrorOf(views, calibration, mean.panel_from_camera);
  const double angle = options.mean_angle_deviation * M_PI / 180.0;
  mean.covariance.diagonal().head<3>().setConstant(std::pow(options.mean_position_deviation, 2));
  mean.covariance.diagonal().tail<3>().setConstant(angle * angle);
  return {mean};
}

}  // namespace grid_path_planner::vision
