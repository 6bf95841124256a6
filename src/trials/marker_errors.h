// Marker poses of a run, drawn from the errors that rendered images showed.
//
//   const MarkerErrors errors(study, frames);             // of turbid water
//   const auto pose = errors.drawn(set, Method::JOINT, frame, noise);
//
// A pose is drawn from one of the rendered frames that were taken from nearly the same place: its error, in the
// camera's frame, is put on the true pose. Noise of the corners is new in each image wherever it was taken, so that
// joint poses with that are drawn from all frames, in deviations of their covariance: those of some neighbours
// repeat, and the filter takes each repetition for news. A frame in which the images showed no pose has none.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "trials/marker_views.h"
#include "trials/noise.h"

namespace grid_path_planner::trials {

enum class Method { MEAN, JOINT };

// In coordinates of the camera: the position's error (m), then the right error of the attitude (rad).
struct CameraError {
  vision::Vector6 error = vision::Vector6::Zero();
  vision::Matrix6 covariance =
      vision::Matrix6::Zero();  // as the joint solution states it; 0: none stated
};

class MarkerErrors {
 public:
  // `frames`: all of the drive in one water, in their order.
  MarkerErrors(const TrialStudy& study, const std::vector<SeenFrame>& frames);

  // Of this frame itself.
  std::optional<CameraError> shown(std::size_t set, Method method, int frame) const;
  std::optional<CameraError> drawn(std::size_t set, Method method, int frame, Noise& noise) const;

  // Of the optical frame in the panel's.
  const Eigen::Isometry3d& truth(int frame) const {
    return truths_[static_cast<std::size_t>(frame)];
  }

 private:
  void findNeighbours();

  std::vector<Eigen::Isometry3d> truths_;
  // By error set, method, frame.
  std::vector<std::array<std::vector<std::optional<CameraError>>, 2>> errors_;
  std::vector<std::vector<CameraError>> from_noise_;  // all joint ones of a set with noisy corners
  std::vector<std::vector<int>> neighbours_;  // of each frame, itself included, the nearest first
};

}  // namespace grid_path_planner::trials
