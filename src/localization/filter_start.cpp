#include "localization/filter_start.h"

#include <algorithm>
#include <cmath>

#include "base/cholesky.h"
#include "localization/measurement_models.h"

namespace grid_path_planner::localization {

namespace {

// What two fixes may be apart grows no longer: with an acoustic fix each 10 s an outlier of 15 m would be believed.
constexpr double kLongestDrift = 3.0;  // s

// About the axes of the world, as errors of the body.
Eigen::Matrix3d attitudeCovariance(const Eigen::Quaterniond& attitude, double tilt, double yaw) {
  const Eigen::Matrix3d to_body = attitude.toRotationMatrix().transpose();
  return to_body * Eigen::Vector3d(tilt, tilt, yaw).asDiagonal() * to_body.transpose();
}

}  // namespace

Estimate estimateAt(const MountedPose& pose, const FilterOptions& options) {
  Estimate estimate;
  estimate.state.position = pose.position;
  estimate.state.attitude = pose.attitude.normalized();
  Covariance& all = estimate.covariance;
  forget(all, kVelocity, 3, square(options.start_velocity));
  forget(all, kGyroBias, 3, square(options.gyro_bias));
  forget(all, kAccelerometerBias, 3, square(options.accelerometer_bias));
  all.block<3, 3>(kPosition, kPosition) = pose.covariance.topLeftCorner<3, 3>();
  all.block<3, 3>(kPosition, kAttitude) = pose.covariance.topRightCorner<3, 3>();
  all.block<3, 3>(kAttitude, kPosition) = pose.covariance.bottomLeftCorner<3, 3>();
  all.block<3, 3>(kAttitude, kAttitude) = pose.covariance.bottomRightCorner<3, 3>();
  return estimate;
}

MountedPose poseAtOrigin(const ImuMeasurement& imu, const FilterOptions& options) {
  MountedPose pose{Eigen::Vector3d::Zero(), Eigen::Quaterniond::Identity(), PoseCovariance::Zero()};
  double tilt = options.start_tilt;
  if (imu.attitude) {
    pose.attitude = *imu.attitude;
  } else {
    const Eigen::Vector3d& up = imu.inertial.acceleration;
    const double pitch = std::atan2(-up.x(), std::hypot(up.y(), up.z()));
    const double roll = std::atan2(up.y(), up.z());
    pose.attitude = Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                    Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
    tilt = std::max(tilt, options.accelerometer_bias / options.gravity);
  }
  pose.covariance.bottomRightCorner<3, 3>() = attitudeCovariance(pose.attitude, square(tilt), 0.0);
  return pose;
}

StartAttitude startAttitude(const Eigen::Quaterniond& imu, Stamp now,
                            const std::optional<KnownHeading>& known,
                            const FilterOptions& options) {
  StartAttitude start{imu, square(options.start_tilt), square(options.start_yaw)};
  const double age = known ? secondsBetween(known->stamp, now) : -1.0;
  if (age < 0.0) return start;
  start.attitude = Eigen::AngleAxisd(-known->offset, Eigen::Vector3d::UnitZ()) * imu;
  start.yaw = std::min(start.yaw + known->variance + square(options.gyro_bias * age),
                       std::max(start.yaw, kUnknownHeading));
  return start;
}

KnownHeading knownHeading(Stamp now, const Eigen::Quaterniond& imu, const Estimate& estimate) {
  const Jacobian<1> yaw = yawJacobian(estimate.state);
  return {now, std::remainder(yawOf(imu) - yawOf(estimate.state.attitude), 2.0 * M_PI),
          (yaw * estimate.covariance * yaw.transpose()).value()};
}

MountedPose poseAtFix(const PositionFix& fix, const StartAttitude& start) {
  MountedPose sensor{fix.position, start.attitude, PoseCovariance::Zero()};
  sensor.covariance.topLeftCorner<3, 3>() = fix.covariance;
  sensor.covariance.bottomRightCorner<3, 3>() =
      attitudeCovariance(start.attitude, start.tilt, start.yaw);
  return carried(sensor, {-fix.sensor, Eigen::Quaterniond::Identity()});
}

MountedPose poseAtFix(const PoseFix& fix) {
  return carried({fix.position, fix.attitude, fix.covariance}, inverse(fix.mounting));
}

bool agree(const MountedPose& first, const MountedPose& second, double seconds,
           const FilterOptions& options, double limit) {
  const double drift = std::min(seconds, kLongestDrift);
  Eigen::Matrix<double, 6, 1> difference;
  difference << second.position - first.position,
      logSO3<double>(first.attitude.conjugate() * second.attitude);
  PoseCovariance covariance = first.covariance + second.covariance;
  covariance.topLeftCorner<3, 3>().diagonal().array() += square(options.start_velocity * drift);
  covariance.bottomRightCorner<3, 3>().diagonal().array() += square(options.coast_turn) * drift;
  return base::Cholesky<6>(covariance).squaredMahalanobis(difference) <= limit;
}

void forget(Covariance& covariance, int first, int count, double variance) {
  covariance.middleRows(first, count).setZero();
  covariance.middleCols(first, count).setZero();
  covariance.block(first, first, count, count).diagonal().setConstant(variance);
}

void forgetAttitude(Estimate& estimate, double tilt, double yaw) {
  forget(estimate.covariance, kAttitude, 3, 0.0);
  estimate.covariance.block<3, 3>(kAttitude, kAttitude) =
      attitudeCovariance(estimate.state.attitude, tilt, yaw);
}

}  // namespace grid_path_planner::localization
