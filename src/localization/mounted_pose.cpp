#include "localization/mounted_pose.h"

namespace grid_path_planner::localization {

namespace {

PoseCovariance turned(const PoseCovariance& covariance, const Eigen::Matrix3d& rotation) {
  PoseCovariance turn = PoseCovariance::Identity();
  turn.bottomRightCorner<3, 3>() = rotation;
  return turn * covariance * turn.transpose();
}

}  // namespace

MountedPose poseOf(const Estimate& estimate) {
  MountedPose pose{estimate.state.position, estimate.state.attitude, {}};
  const Covariance& all = estimate.covariance;
  pose.covariance << all.block<3, 3>(kPosition, kPosition), all.block<3, 3>(kPosition, kAttitude),
      all.block<3, 3>(kAttitude, kPosition), all.block<3, 3>(kAttitude, kAttitude);
  return pose;
}

MountedPose carried(const MountedPose& pose, const Mounting& mounting) {
  PoseCovariance jacobian = PoseCovariance::Identity();
  jacobian.topRightCorner<3, 3>() = -pose.attitude.toRotationMatrix() * cross(mounting.position);
  jacobian.bottomRightCorner<3, 3>() = mounting.rotation.toRotationMatrix().transpose();
  return {pose.position + pose.attitude * mounting.position, pose.attitude * mounting.rotation,
          jacobian * pose.covariance * jacobian.transpose()};
}

PoseCovariance worldCovariance(const MountedPose& pose) {
  return turned(pose.covariance, pose.attitude.toRotationMatrix());
}

PoseCovariance ownCovariance(const PoseCovariance& world, const Eigen::Quaterniond& attitude) {
  return turned(world, attitude.toRotationMatrix().transpose());
}

Eigen::Vector3d velocityAt(const State& state, const Eigen::Vector3d& rate,
                           const Mounting& mounting) {
  const Eigen::Vector3d in_body =
      state.attitude.conjugate() * state.velocity + rate.cross(mounting.position);
  return mounting.rotation.conjugate() * in_body;
}

}  // namespace grid_path_planner::localization
