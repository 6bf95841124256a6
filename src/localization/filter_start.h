// The first estimate, and what of an estimate is forgotten when it begins anew.
#pragma once

#include <optional>

#include "localization/filter_options.h"
#include "localization/measurement.h"
#include "localization/mounted_pose.h"
#include "localization/state.h"

namespace grid_path_planner::localization {

// What a filter begins with where a fix is a position alone.
struct StartAttitude {
  Eigen::Quaterniond attitude;
  double tilt, yaw;  // variances, rad^2
};

constexpr double kUnknownHeading = 3.14159265358979 * 3.14159265358979;  // rad^2, the most

// That of the IMU, turned by what is known of its heading: of a time before, since when gyro_bias made it worse. What is
// known from long ago says that the IMU's heading is not to be believed. One of a later time is of another clock.
StartAttitude startAttitude(const Eigen::Quaterniond& imu, Stamp now,
                            const std::optional<KnownHeading>& known, const FilterOptions& options);

// By an estimate of the same time.
KnownHeading knownHeading(Stamp now, const Eigen::Quaterniond& imu, const Estimate& estimate);

// At rest with this pose.
Estimate estimateAt(const MountedPose& pose, const FilterOptions& options);

// At the origin with the attitude of the IMU: its own, else level by its accelerometer with yaw 0.
// Position and yaw are exact: they define the frame.
MountedPose poseAtOrigin(const ImuMeasurement& imu, const FilterOptions& options);

// The pose of the body by a fix of a position.
MountedPose poseAtFix(const PositionFix& fix, const StartAttitude& start);

// The pose of the body by a fix of something mounted on it.
MountedPose poseAtFix(const PoseFix& fix);

// Whether two fixes can be of one vehicle, so many seconds apart; more than 3 s apart as if it were 3 s: a vehicle whose
// fixes are seldom begins where it stands or is slow.
bool agree(const MountedPose& first, const MountedPose& second, double seconds,
           const FilterOptions& options, double limit);

// Gives `count` errors from `first` on this variance, and no correlation with the others.
void forget(Covariance& covariance, int first, int count, double variance);

// Gives the attitude these variances, rad^2, and no correlation.
void forgetAttitude(Estimate& estimate, double tilt, double yaw);

}  // namespace grid_path_planner::localization
