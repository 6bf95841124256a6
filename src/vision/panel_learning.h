// Where a panel is in the map, learnt while a vehicle stands still before it.
//
//   PanelSightings sightings(options);
//   sightings.add(sightingOf(seconds, map_from_base, base_from_camera, pose));     // of each image
//   const PanelPose panel = sightings.learnt();                                 // throws InputError
//
// The pose is the mean over the last images: of the positions, and of the attitudes as meanAttitude() has it.
#pragma once

#include <deque>

#include "vision/panel_learning_options.h"
#include "vision/pose_estimate.h"

namespace grid_path_planner::vision {

struct PanelPose {
  Eigen::Isometry3d map_from_panel = Eigen::Isometry3d::Identity();
  // Of the position in the map (m), then of the right error of the attitude (rad).
  Matrix6 covariance = Matrix6::Zero();
};

struct PanelSighting {
  double time = 0.0;  // s
  Eigen::Isometry3d map_from_base = Eigen::Isometry3d::Identity();
  PanelPose panel;
};

// What a camera's pose before the panel says of the panel, by a vehicle whose pose counts as known.
PanelSighting sightingOf(double time, const Eigen::Isometry3d& map_from_base,
                         const Eigen::Isometry3d& base_from_camera, const PoseEstimate& pose);

class PanelSightings {
 public:
  explicit PanelSightings(const PanelLearningOptions& options) : options_(options) {}

  void use(const PanelLearningOptions& options) { options_ = options; }
  // In the order of time; what is before a gap of 2 s is forgotten.
  void add(const PanelSighting& sighting);
  void clear() { sightings_.clear(); }

  // Its covariance is the mean of the images', since what they have in common does not average out. Throws
  // InputError where there are too few images, and where vehicle or panel moved.
  PanelPose learnt() const;

 private:
  void check() const;

  PanelLearningOptions options_;
  std::deque<PanelSighting> sightings_;
};

}  // namespace grid_path_planner::vision
