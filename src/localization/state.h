// What the filter estimates, and the 15 errors of it that have a covariance.
//
//   Estimate estimate;
//   estimate.state = retract(estimate.state, error);      // error: 15 numbers
//   ErrorVector error = errorBetween(estimate.state, truth);
//
// The *body frame* is that of the IMU (x forward, y left, z up where it is mounted so); the *world
// frame* is level, z up. The attitude turns vectors of the body frame into the world frame. Errors,
// in their order: position (m, world), velocity (m/s, world), attitude (rad, body: the true attitude
// is attitude * exp(error)), gyro bias (rad/s, body), accelerometer bias (m/s^2, body).
//
// Small errors are differences. Over a large error of the heading, that of the velocity runs along the arc
// that it turns it on (exponential of SE_2(3), for turns about the vertical), so that of a vehicle whose
// heading is off by any angle the velocity in its own frame is as well known as it was measured. Not so
// the position, which fixes measure in the world, nor over errors of the tilt, which gravity tells.
// Source: A. Barrau, S. Bonnabel, The invariant extended Kalman filter as a stable observer, 2017.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "localization/so3.h"

namespace grid_path_planner::localization {

constexpr int kErrors = 15;
constexpr int kPosition = 0, kVelocity = 3, kAttitude = 6, kGyroBias = 9, kAccelerometerBias = 12;

using ErrorVector = Eigen::Matrix<double, kErrors, 1>;
using Covariance = Eigen::Matrix<double, kErrors, kErrors>;

template <class T>
struct BasicState {
  Vector3<T> position = Vector3<T>::Zero();
  Vector3<T> velocity = Vector3<T>::Zero();
  Eigen::Quaternion<T> attitude = Eigen::Quaternion<T>(T(1.0), T(0.0), T(0.0), T(0.0));
  Vector3<T> gyro_bias = Vector3<T>::Zero();
  Vector3<T> accelerometer_bias = Vector3<T>::Zero();
};

using State = BasicState<double>;

inline double square(double value) {
  return value * value;
}

struct Estimate {
  State state;
  Covariance covariance = Covariance::Zero();
};

// Whether all numbers of state and covariance are.
bool isFinite(const Estimate& estimate);

// The standard deviation of the three errors from `first`, along their worst axis; infinite where the covariance is not
// finite.
double worstDeviation(const Covariance& covariance, int first);

// A place on the vehicle in the body frame: turns and then shifts vectors of its frame.
struct Mounting {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

Mounting inverse(const Mounting& mounting);
// What is mounted so on something that is itself mounted.
Mounting operator*(const Mounting& outer, const Mounting& inner);

// The part about the world's z axis of a turn of the body.
template <class T>
Vector3<T> vertical(const Eigen::Quaternion<T>& attitude, const Vector3<T>& turn) {
  return {T(0.0), T(0.0), (attitude * turn).z()};
}

template <class T>
BasicState<T> retract(const BasicState<T>& state, const Eigen::Matrix<T, kErrors, 1>& error) {
  const Vector3<T> turn = error.template segment<3>(kAttitude);
  const Eigen::Matrix<T, 3, 3> arc = leftJacobian<T>(vertical(state.attitude, turn));
  BasicState<T> result = state;
  result.position += error.template segment<3>(kPosition);
  result.velocity += arc * error.template segment<3>(kVelocity);
  result.attitude = state.attitude * expSO3<T>(turn);
  result.gyro_bias += error.template segment<3>(kGyroBias);
  result.accelerometer_bias += error.template segment<3>(kAccelerometerBias);
  return result;
}

// retract(from, errorBetween(from, to)) is `to`.
template <class T>
Eigen::Matrix<T, kErrors, 1> errorBetween(const BasicState<T>& from, const BasicState<T>& to) {
  const Eigen::Quaternion<T> turn = from.attitude.conjugate() * to.attitude;
  const Vector3<T> angle = logSO3<T>(turn);
  const Eigen::Matrix<T, 3, 3> chord = leftJacobianInverse<T>(vertical(from.attitude, angle));
  Eigen::Matrix<T, kErrors, 1> error;
  error.template segment<3>(kPosition) = to.position - from.position;
  error.template segment<3>(kVelocity) = chord * (to.velocity - from.velocity);
  error.template segment<3>(kAttitude) = angle;
  error.template segment<3>(kGyroBias) = to.gyro_bias - from.gyro_bias;
  error.template segment<3>(kAccelerometerBias) = to.accelerometer_bias - from.accelerometer_bias;
  return error;
}

// About the world's z axis, from x; of roll, pitch and yaw (turns about x, y, z in this order).
double yawOf(const Eigen::Quaterniond& attitude);

}  // namespace grid_path_planner::localization
