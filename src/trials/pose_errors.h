// How far an estimated trajectory is off, in the measures that the field uses.
//
//   const double m_a = smoothnessOf(positions);
//   const double ate = absoluteError(estimate, truth);
//   const std::optional<PoseError> rpe = relativeError(estimate, truth, 5.0);
//
// Trajectories are compared pose by pose, of the same times, in one frame: nothing is aligned.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace grid_path_planner::trials {

struct TimedPose {
  double time = 0.0;                                   // s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
};

using PoseTrack = std::vector<TimedPose>;

// Euclidean distance and geodesic angle.
struct PoseError {
  double metres = 0.0;
  double degrees = 0.0;
};

PoseError errorOf(const Eigen::Vector3d& position, const Eigen::Quaterniond& attitude,
                  const Eigen::Vector3d& true_position, const Eigen::Quaterniond& true_attitude);

// Lag-one autocorrelation of vectors about their mean, normalised. NaN for fewer than two, 0 where all are equal.
double autocorrelationOf(const std::vector<Eigen::Vector3d>& vectors);

// The same of the increments of the position: 1 for a motion that
// hardly changes from one to the next, 0 for a random walk, -1/2 for noise about a place.
double smoothnessOf(const std::vector<Eigen::Vector3d>& positions);

// ATE: the root mean square of the distances. Precondition: as many poses in both, at least one.
double absoluteError(const PoseTrack& estimate, const PoseTrack& truth);

// RPE: root mean squares of how far the motion over `metres` of the true path is off, from each pose to the first
// that is so far along the path; none where the path is shorter. Precondition: as many poses in both.
std::optional<PoseError> relativeError(const PoseTrack& estimate, const PoseTrack& truth,
                                       double metres);

// A line "time x y z qx qy qz qw" for each pose, as evo and the TUM RGB-D benchmark have it.
std::string tumText(const PoseTrack& track);

}  // namespace grid_path_planner::trials
