// What a sensor would measure in a given state, and how that changes with each of the 15 errors.
//
// The predictions are templates, so that tests differentiate them automatically; the Jacobians, d
// (prediction) / d (error), are closed forms beside them. For a pose the residual is predicted, whose
// Jacobian holds at any size of it.
#pragma once

#include <Eigen/Core>

#include "localization/measurement.h"
#include "localization/state.h"

namespace grid_path_planner::localization {

template <int N>
using Jacobian = Eigen::Matrix<double, N, kErrors>;

// Velocity over ground of a sensor in its own frame; `rate`: of the body as the gyro measures it.
template <class T>
Vector3<T> predictedVelocity(const BasicState<T>& state, const Eigen::Vector3d& rate,
                             const Mounting& sensor) {
  const Vector3<T> turning = rate.cast<T>() - state.gyro_bias;
  const Vector3<T> lever = sensor.position.cast<T>();
  const Vector3<T> in_body =
      state.attitude.toRotationMatrix().transpose() * state.velocity + turning.cross(lever);
  return sensor.rotation.toRotationMatrix().transpose().cast<T>() * in_body;
}
Jacobian<3> velocityJacobian(const State& state, const Mounting& sensor);

// Position of a place on the vehicle in the world.
template <class T>
Vector3<T> predictedPosition(const BasicState<T>& state, const Eigen::Vector3d& place) {
  return state.position + state.attitude.toRotationMatrix() * place.cast<T>();
}
Jacobian<3> positionJacobian(const State& state, const Eigen::Vector3d& place);

// Of the body, rad.
template <class T>
T predictedYaw(const BasicState<T>& state) {
  using std::atan2;
  const Eigen::Matrix<T, 3, 3> rotation = state.attitude.toRotationMatrix();
  return atan2(rotation(1, 0), rotation(0, 0));
}
// Grows without bound towards the vertical, where there is no yaw.
Jacobian<1> yawJacobian(const State& state);

// The fix minus what is expected: position in the world, attitude as the rotation vector from the
// expected to the fixed one.
template <class T>
Eigen::Matrix<T, 6, 1> poseResidual(const BasicState<T>& state, const PoseFix& fix) {
  Eigen::Matrix<T, 6, 1> residual;
  residual.template head<3>() =
      fix.position.cast<T>() - predictedPosition<T>(state, fix.mounting.position);
  const Eigen::Quaternion<T> expected = state.attitude * fix.mounting.rotation.cast<T>();
  const Eigen::Quaternion<T> turn = expected.conjugate() * fix.attitude.cast<T>();
  residual.template tail<3>() = logSO3<T>(turn);
  return residual;
}
// Of the prediction: minus that of the residual.
Jacobian<6> poseJacobian(const State& state, const PoseFix& fix);

}  // namespace grid_path_planner::localization
