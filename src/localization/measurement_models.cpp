#include "localization/measurement_models.h"

namespace grid_path_planner::localization {

Jacobian<3> velocityJacobian(const State& state, const Mounting& sensor) {
  const Eigen::Matrix3d to_body = state.attitude.toRotationMatrix().transpose();
  const Eigen::Matrix3d to_sensor = sensor.rotation.toRotationMatrix().transpose();
  Jacobian<3> jacobian = Jacobian<3>::Zero();
  jacobian.middleCols<3>(kVelocity) = to_sensor * to_body;
  jacobian.middleCols<3>(kAttitude) = to_sensor * cross(to_body * state.velocity);
  jacobian.middleCols<3>(kGyroBias) = to_sensor * cross(sensor.position);
  return jacobian;
}

Jacobian<3> positionJacobian(const State& state, const Eigen::Vector3d& place) {
  Jacobian<3> jacobian = Jacobian<3>::Zero();
  jacobian.middleCols<3>(kPosition).setIdentity();
  jacobian.middleCols<3>(kAttitude) = -state.attitude.toRotationMatrix() * cross(place);
  return jacobian;
}

Jacobian<1> yawJacobian(const State& state) {
  const Eigen::Matrix3d r = state.attitude.toRotationMatrix();
  const double level = r(0, 0) * r(0, 0) + r(1, 0) * r(1, 0);
  Jacobian<1> jacobian = Jacobian<1>::Zero();
  // r exp(d) has the first column r.col(0) + d_z r.col(1) - d_y r.col(2) to first order.
  jacobian(kAttitude + 1) = (r(1, 0) * r(0, 2) - r(0, 0) * r(1, 2)) / level;
  jacobian(kAttitude + 2) = (r(0, 0) * r(1, 1) - r(1, 0) * r(0, 1)) / level;
  return jacobian;
}

Jacobian<6> poseJacobian(const State& state, const PoseFix& fix) {
  Jacobian<6> jacobian;
  jacobian.topRows<3>() = positionJacobian(state, fix.mounting.position);
  jacobian.bottomRows<3>().setZero();
  const Eigen::Vector3d turn = poseResidual<double>(state, fix).tail<3>();
  jacobian.block<3, 3>(3, kAttitude) =
      leftJacobianInverse(turn) * fix.mounting.rotation.toRotationMatrix().transpose();
  return jacobian;
}

}  // namespace grid_path_planner::localization
