#include "trials/marker_errors.h"

#include <algorithm>

#include "base/cholesky.h"
#include "localization/so3.h"
#include "simulation/camera/pinhole.h"

namespace grid_path_planner::trials {

using Eigen::Isometry3d, Eigen::Matrix3d, Eigen::Quaterniond;

namespace {

constexpr std::size_t kNeighbours = 25;

CameraError errorFrom(const CameraPose& pose, const Isometry3d& truth) {
  CameraError error;
  const Quaterniond turn = Quaterniond(truth.linear()).conjugate() * pose.attitude;
  error.error << truth.linear().transpose() * (pose.position - truth.translation()),
      localization::logSO3<double>(turn);
  return error;
}

CameraError errorFrom(const JointPose& pose, const Isometry3d& truth) {
  CameraError error = errorFrom(pose.camera, truth);
  vision::Matrix6 into_camera = vision::Matrix6::Identity();
  into_camera.topLeftCorner<3, 3>() = truth.linear().transpose();
  error.covariance = into_camera * pose.covariance * into_camera.transpose();
  return error;
}

// The error as many deviations off as `drawn` is, in those of another covariance.
CameraError rescaled(const CameraError& drawn, const vision::Matrix6& covariance) {
  vision::Matrix6 from = drawn.covariance, into = covariance;
  base::factorizeCholesky(from.data(), from.rows());
  base::factorizeCholesky(into.data(), into.rows());
  vision::Vector6 deviations = drawn.error;
  base::solveLower(from.data(), from.rows(), deviations.data());
  return {into.triangularView<Eigen::Lower>() * deviations, covariance};
}

// Metres, a radian of the line of sight counting as one.
double distance(const Isometry3d& a, const Isometry3d& b) {
  return (a.translation() - b.translation()).norm() +
         (a.linear().col(2) - b.linear().col(2)).norm();
}

}  // namespace

MarkerErrors::MarkerErrors(const TrialStudy& study, const std::vector<SeenFrame>& frames)
    : errors_(study.sets.size()), from_noise_(study.sets.size()) {
  const PanelDrive drive(study.drive, study.map_from_panel);
  const Isometry3d base_from_camera = study.camera.mounting.pose() * simulation::opticalFrame();
  for (const SeenFrame& frame : frames) {
    truths_.push_back(study.map_from_panel.inverse() *
                      mapFromBase(drive.stateAt(frameTime(study, frame.frame))) * base_from_camera);
    for (std::size_t set = 0; set < errors_.size(); ++set) {
      const ViewSolution& solution = frame.solutions[set];
      std::optional<CameraError> mean, joint;
      if (solution.mean) mean = errorFrom(*solution.mean, truths_.back());
      if (solution.joint) joint = errorFrom(*solution.joint, truths_.back());
      errors_[set][static_cast<std::size_t>(Method::MEAN)].push_back(mean);
      errors_[set][static_cast<std::size_t>(Method::JOINT)].push_back(joint);
      if (joint && study.sets[set].corner_noise > 0.0) from_noise_[set].push_back(*joint);
    }
  }
  findNeighbours();
}

void MarkerErrors::findNeighbours() {
  for (const Isometry3d& from : truths_) {
    std::vector<std::pair<double, int>> all;
    for (std::size_t i = 0; i < truths_.size(); ++i)
      all.emplace_back(distance(from, truths_[i]), static_cast<int>(i));
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(kNeighbours, all.size()));
    std::partial_sort(all.begin(), end, all.end());
    neighbours_.emplace_back();
    for (auto each = all.begin(); each != end; ++each) neighbours_.back().push_back(each->second);
  }
}

std::optional<CameraError> MarkerErrors::shown(std::size_t set, Method method, int frame) const {
  return errors_[set][static_cast<std::size_t>(method)][static_cast<std::size_t>(frame)];
}

std::optional<CameraError> MarkerErrors::drawn(std::size_t set, Method method, int frame,
                                               Noise& noise) const {
  const auto own = shown(set, method, frame);
  if (own && method == Method::JOINT && !from_noise_[set].empty())
    return rescaled(from_noise_[set][noise.below(from_noise_[set].size())], own->covariance);
  const std::vector<int>& near = neighbours_[static_cast<std::size_t>(frame)];
  const std::size_t first = noise.below(near.size());
  if (!own) return {};
  for (std::size_t i = 0; i < near.size(); ++i)
    if (const auto error = shown(set, method, near[(first + i) % near.size()])) return error;
  return {};
}

}  // namespace grid_path_planner::trials
