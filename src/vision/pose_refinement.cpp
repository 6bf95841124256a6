#include "vision/pose_refinement.h"

#include <algorithm>
#include <cmath>

#include "base/cholesky.h"

namespace grid_path_planner::vision {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d, Eigen::Vector3d;

constexpr int kIterations = 60;
constexpr double kNearest = 1e-6;        // m ahead of the camera
constexpr double kSmallestStep = 1e-10;  // m and rad

struct NormalEquations {
  Matrix6 hessian = Matrix6::Zero();  // J^T J
  Vector6 gradient = Vector6::Zero();
};

Isometry3d moved(const Isometry3d& pose, const Vector6& step) {
  Isometry3d result = pose;
  result.translation() += step.head<3>();
  const double angle = step.tail<3>().norm();
  if (angle > 0.0) result.rotate(Eigen::AngleAxisd(angle, step.tail<3>() / angle));
  return result;
}

NormalEquations equationsAt(const MarkerViews& views, const CameraCalibration& calibration,
                            const Isometry3d& pose) {
  const Isometry3d camera_from_panel = pose.inverse(Eigen::Isometry);
  NormalEquations equations;
  for (const MarkerView& view : views)
    for (int i = 0; i < 4; ++i) {
      const Vector3d p = camera_from_panel * view.points[i];
      Eigen::Matrix<double, 2, 3> projection;  // by the point in the camera's frame
      projection << calibration.fx / p.z(), 0.0, -calibration.fx * p.x() / (p.z() * p.z()),  //
          0.0, calibration.fy / p.z(), -calibration.fy * p.y() / (p.z() * p.z());
      Eigen::Matrix<double, 3, 6> point;  // by the pose
      point << -camera_from_panel.linear(), crossMatrix(p);
      const Eigen::Matrix<double, 2, 6> jacobian = projection * point;
      const Vector2d residual = view.corners[i] - calibration.projected(p);
      equations.hessian += jacobian.transpose() * jacobian;
      equations.gradient += jacobian.transpose() * residual;
    }
  return equations;
}

Vector6 dampedStep(const NormalEquations& equations, double damping) {
  Matrix6 damped = equations.hessian;
  damped.diagonal() *= 1.0 + damping;
  return base::Cholesky<6>(damped).solved(equations.gradient);
}

// Steps downhill until none is left that is worth it.
void minimise(const MarkerViews& views, const CameraCalibration& calibration, PoseEstimate& best) {
  double damping = 1e-3;
  NormalEquations equations = equationsAt(views, calibration, best.panel_from_camera);
  for (int i = 0; i < kIterations && damping < 1e12; ++i) {
    const Vector6 step = dampedStep(equations, damping);
    if (!step.allFinite() || step.norm() < kSmallestStep) return;
    const Isometry3d next = moved(best.panel_from_camera, step);
    const double error = squaredErrorOf(views, calibration, next);
    if (!(error < best.squared_error)) {
      damping *= 10.0;
      continue;
    }
    best.panel_from_camera = next;
    best.squared_error = error;
    damping *= 0.1;
    equations = equationsAt(views, calibration, next);
  }
}

}  // namespace

double varianceOf(const PoseEstimate& pose, std::size_t markers, double pixel_noise) {
  const double freedom = 8.0 * static_cast<double>(markers) - 6.0;
  return std::max(pixel_noise * pixel_noise, pose.squared_error / freedom);
}

PoseEstimate refined(const MarkerViews& views, const CameraCalibration& calibration,
                     const Isometry3d& start, double pixel_noise) {
  PoseEstimate pose;
  pose.panel_from_camera = start;
  pose.squared_error = squaredErrorOf(views, calibration, start);
  if (!std::isfinite(pose.squared_error)) return pose;
  minimise(views, calibration, pose);
  const Matrix6 hessian = equationsAt(views, calibration, pose.panel_from_camera).hessian;
  pose.covariance =
      varianceOf(pose, views.size(), pixel_noise) * base::Cholesky<6>(hessian).inverse();
  if (!pose.covariance.allFinite()) pose.squared_error = INFINITY;
  return pose;
}

double squaredErrorOf(const MarkerViews& views, const CameraCalibration& calibration,
                      const Isometry3d& pose) {
  const Isometry3d camera_from_panel = pose.inverse(Eigen::Isometry);
  double sum = 0.0;
  for (const MarkerView& view : views)
    for (int i = 0; i < 4; ++i) {
      const Vector3d point = camera_from_panel * view.points[i];
      if (!(point.z() > kNearest)) return INFINITY;
      sum += (view.corners[i] - calibration.projected(point)).squaredNorm();
    }
  return sum;
}

}  // namespace grid_path_planner::vision
