// A pose with its covariance, carried from one place of the vehicle to another.
//
//   const MountedPose base = carried(poseOf(estimate), base_in_body);
//   const PoseCovariance as_in_ros = worldCovariance(base);      // about the world's axes
#pragma once

#include "localization/measurement.h"
#include "localization/state.h"

namespace grid_path_planner::localization {

using PoseCovariance = Eigen::Matrix<double, 6, 6>;

struct MountedPose {
  Eigen::Vector3d position;  // m, world
  Eigen::Quaterniond attitude;
  // Position (world), then attitude (right error, in the frame of what has this pose).
  PoseCovariance covariance;
};

// Of the body.
MountedPose poseOf(const Estimate& estimate);

// The pose of what is mounted so on what has `pose`.
MountedPose carried(const MountedPose& pose, const Mounting& mounting);

// With errors of the attitude as turns about the world's axes, as geometry_msgs has them, and back.
PoseCovariance worldCovariance(const MountedPose& pose);
PoseCovariance ownCovariance(const PoseCovariance& world, const Eigen::Quaterniond& attitude);

// Of what is mounted so, in its own frame, m/s; `rate`: of the body, without the gyro's bias.
Eigen::Vector3d velocityAt(const State& state, const Eigen::Vector3d& rate,
                           const Mounting& mounting);

}  // namespace grid_path_planner::localization
