#include "vision/pose_candidates.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "base/cholesky.h"
#include "vision/pose_refinement.h"

namespace grid_path_planner::vision {
namespace {

using Eigen::Isometry3d, Eigen::Vector3d;

constexpr double kSame = 1e-3;  // m and rad: minima nearer than this are one

Isometry3d poseOf(const cv::Vec3d& rotation, const cv::Vec3d& translation) {
  const Vector3d turn(rotation[0], rotation[1], rotation[2]);
  Isometry3d pose(Eigen::Translation3d(translation[0], translation[1], translation[2]));
  const double angle = turn.norm();
  if (angle > 0.0) pose.rotate(Eigen::AngleAxisd(angle, turn / angle));
  return pose;
}

bool isConvexQuad(const PixelCorners& corners) {
  int turns = 0;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d a = corners[(i + 1) % 4] - corners[i];
    const Eigen::Vector2d b = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    turns += a.x() * b.y() - a.y() * b.x() > 0.0 ? 1 : -1;
  }
  return turns == 4;  // clockwise in an image, whose rows run down
}

bool isNear(const PoseEstimate& a, const PoseEstimate& b) {
  return differenceOf(a.panel_from_camera, b.panel_from_camera).cwiseAbs().maxCoeff() < kSame;
}

// Half of the turn and of the displacement from one pose to the other, about the middle of what is seen.
Isometry3d poseBetween(const Isometry3d& a, const Isometry3d& b, const MarkerViews& views) {
  Vector3d middle = Vector3d::Zero();
  for (const MarkerView& view : views)
    for (const Vector3d& point : view.points)
      middle += point / (4.0 * static_cast<double>(views.size()));
  const Eigen::Translation3d to_middle(middle);
  const Isometry3d camera_from_a = a.inverse() * to_middle, camera_from_b = b.inverse() * to_middle;
  Isometry3d between(
      Eigen::Translation3d(0.5 * (camera_from_a.translation() + camera_from_b.translation())));
  between.rotate(Eigen::Quaterniond(camera_from_a.rotation())
                     .slerp(0.5, Eigen::Quaterniond(camera_from_b.rotation())));
  return to_middle * between.inverse(Eigen::Isometry);
}

// Whether `pose`, whose squared error is larger by `more` variances, is as far from the minimum as the covariance says
// that it may be: where the error grows less than a quarter as fast, the minimum is no well but a valley.
bool explains(const PoseEstimate& minimum, const Isometry3d& pose, double more) {
  const Vector6 difference = differenceOf(pose, minimum.panel_from_camera);
  return base::Cholesky<6>(minimum.covariance).squaredMahalanobis(difference) <
         kPoseGate + 4.0 * more;
}

}  // namespace

std::vector<Isometry3d> posesByOneMarker(const MarkerView& view, const MarkerLayout& layout,
                                         const CameraCalibration& c) {
  std::vector<Isometry3d> poses;
  if (!isConvexQuad(view.corners)) return poses;
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (const Vector3d& corner : tagCorners(layout.tag_size))
    points.emplace_back(corner.x(), corner.y(), corner.z());
  for (const Eigen::Vector2d& corner : view.corners) pixels.emplace_back(corner.x(), corner.y());
  std::vector<cv::Mat> rotations, translations;
  cv::solvePnPGeneric(points, pixels, cv::Matx33d(c.fx, 0.0, c.cx, 0.0, c.fy, c.cy, 0.0, 0.0, 1.0),
                      cv::noArray(), rotations, translations, false, cv::SOLVEPNP_IPPE_SQUARE);
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const Isometry3d camera_from_tag = poseOf(cv::Vec3d(rotations[i]), cv::Vec3d(translations[i]));
    if (camera_from_tag.matrix().allFinite())
      poses.push_back(layout.panel_from_tag.at(view.id) * camera_from_tag.inverse(Eigen::Isometry));
  }
  return poses;
}

std::vector<PoseEstimate> jointPoses(const MarkerViews& views, const MarkerLayout& layout,
                                     const CameraCalibration& calibration, double pixel_noise) {
  std::vector<PoseEstimate> found;
  for (const MarkerView& view : views)
    for (const Isometry3d& start : posesByOneMarker(view, layout, calibration)) {
      const PoseEstimate pose = refined(views, calibration, start, pixel_noise);
      if (std::isfinite(pose.squared_error)) found.push_back(pose);
    }
  std::stable_sort(found.begin(), found.end(), [](const PoseEstimate& a, const PoseEstimate& b) {
    return a.squared_error < b.squared_error;
  });
  std::vector<PoseEstimate> distinct;
  for (const PoseEstimate& pose : found)
    if (std::none_of(distinct.begin(), distinct.end(),
                     [&](const PoseEstimate& other) { return isNear(pose, other); }))
      distinct.push_back(pose);
  return distinct;
}

bool admitPosesBetween(const MarkerViews& views, const MarkerLayout& layout,
                       const CameraCalibration& calibration,
                       const std::vector<PoseEstimate>& minima, double variance, double limit) {
  const PoseEstimate& best = minima.front();
  const auto more = [&](const Isometry3d& pose) {
    return (squaredErrorOf(views, calibration, pose) - best.squared_error) / variance;
  };
  for (std::size_t i = 1; i < minima.size(); ++i)
    if (more(poseBetween(best.panel_from_camera, minima[i].panel_from_camera, views)) <= limit)
      return true;
  for (const MarkerView& view : views)
    for (const Isometry3d& pose : posesByOneMarker(view, layout, calibration))
      if (more(pose) <= limit &&
          std::none_of(minima.begin(), minima.end(),
                       [&](const auto& minimum) { return explains(minimum, pose, more(pose)); }))
        return true;
  return false;
}

}  // namespace grid_path_planner::vision
