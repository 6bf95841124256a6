// How the state and its covariance move on with what the IMU measured.
//
//   propagate(estimate, {rate, acceleration}, seconds, noise);
//
// Rate and specific force are constant over the step, the force taken at half of the step's turn, so
// that a circle at constant rate errs by the square of the angle of a step only. The Jacobian of the
// step is exact (closed form); the covariance is multiplied by its blocks that are not zero. Biases
// are random walks. The Earth's rotation, 7e-5 rad/s, becomes a part of the gyro bias.
#pragma once

#include <Eigen/Core>

#include "localization/state.h"

namespace grid_path_planner::localization {

struct Inertial {
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();          // rad/s, body
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // specific force, m/s^2, body
};

struct ImuNoise {
  double gyro = 0.0;                // rad/s/sqrt(Hz)
  double gyro_walk = 0.0;           // rad/s^2/sqrt(Hz)
  double accelerometer = 0.0;       // m/s^2/sqrt(Hz)
  double accelerometer_walk = 0.0;  // m/s^3/sqrt(Hz)
  double gravity = 9.80665;         // m/s^2, against the world's z axis
};

template <class T>
BasicState<T> propagated(const BasicState<T>& state, const Inertial& imu, double seconds,
                         double gravity) {
  const Vector3<T> turn = (imu.rate.cast<T>() - state.gyro_bias) * T(seconds);
  const Vector3<T> force = imu.acceleration.cast<T>() - state.accelerometer_bias;
  const Vector3<T> half_turn = turn * T(0.5);
  const Eigen::Quaternion<T> half = state.attitude * expSO3<T>(half_turn);
  Vector3<T> acceleration = half.toRotationMatrix() * force;
  acceleration.z() -= T(gravity);
  BasicState<T> result = state;
  result.position += state.velocity * T(seconds) + acceleration * T(0.5 * seconds * seconds);
  result.velocity += acceleration * T(seconds);
  result.attitude = state.attitude * expSO3<T>(turn);
  result.attitude.normalize();
  return result;
}

// d(error after) / d(error before) of propagated(). Only these blocks differ from the identity.
struct PropagationJacobian {
  double seconds = 0.0;
  Eigen::Matrix3d velocity_attitude, velocity_gyro_bias, velocity_accelerometer_bias;
  Eigen::Matrix3d attitude_attitude, attitude_gyro_bias;
  // Those of the position are half of `seconds` times those of the velocity.
};

PropagationJacobian propagationJacobian(const State& state, const Inertial& imu, double seconds);

// As a matrix.
Covariance dense(const PropagationJacobian& jacobian);

// What a step of `seconds` adds to the covariance.
void addProcessNoise(Covariance& covariance, double seconds, const ImuNoise& noise);

void propagate(Estimate& estimate, const Inertial& imu, double seconds, const ImuNoise& noise);

}  // namespace grid_path_planner::localization
