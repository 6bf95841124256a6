#include "localization/imu_propagation.h"

namespace grid_path_planner::localization {

namespace {

using Rows = Eigen::Matrix<double, 3, kErrors>;

// jacobian * covariance
Covariance timesCovariance(const PropagationJacobian& jacobian, const Covariance& covariance) {
  const auto rows = [&](int of) { return covariance.middleRows<3>(of); };
  Covariance product = covariance;
  const Rows change = jacobian.velocity_attitude * rows(kAttitude) +
                      jacobian.velocity_gyro_bias * rows(kGyroBias) +
                      jacobian.velocity_accelerometer_bias * rows(kAccelerometerBias);
  product.middleRows<3>(kPosition) +=
      jacobian.seconds * rows(kVelocity) + 0.5 * jacobian.seconds * change;
  product.middleRows<3>(kVelocity) += change;
  product.middleRows<3>(kAttitude) =
      jacobian.attitude_attitude * rows(kAttitude) + jacobian.attitude_gyro_bias * rows(kGyroBias);
  return product;
}

}  // namespace

void addProcessNoise(Covariance& covariance, double seconds, const ImuNoise& noise) {
  const auto add = [&](int row, int column, double variance) {
    covariance.block<3, 3>(row, column).diagonal().array() += variance;
  };
  const double force = noise.accelerometer * noise.accelerometer * seconds;
  add(kVelocity, kVelocity, force);
  add(kPosition, kVelocity, 0.5 * seconds * force);
  add(kVelocity, kPosition, 0.5 * seconds * force);
  add(kPosition, kPosition, seconds * seconds / 3.0 * force);
  add(kAttitude, kAttitude, noise.gyro * noise.gyro * seconds);
  add(kGyroBias, kGyroBias, noise.gyro_walk * noise.gyro_walk * seconds);
  add(kAccelerometerBias, kAccelerometerBias,
      noise.accelerometer_walk * noise.accelerometer_walk * seconds);
}

PropagationJacobian propagationJacobian(const State& state, const Inertial& imu, double seconds) {
  const Eigen::Vector3d turn = (imu.rate - state.gyro_bias) * seconds;
  const Eigen::Vector3d half_turn = 0.5 * turn;
  const Eigen::Vector3d force = imu.acceleration - state.accelerometer_bias;
  const Eigen::Matrix3d attitude = state.attitude.toRotationMatrix();
  const Eigen::Matrix3d half = expSO3<double>(half_turn).toRotationMatrix();
  PropagationJacobian jacobian;
  jacobian.seconds = seconds;
  jacobian.velocity_accelerometer_bias = -seconds * attitude * half;
  jacobian.velocity_attitude = -seconds * attitude * cross(half * force);
  jacobian.velocity_gyro_bias = -0.5 * seconds * jacobian.velocity_accelerometer_bias *
                                cross(force) * rightJacobian(half_turn);
  jacobian.attitude_attitude = (half * half).transpose();
  jacobian.attitude_gyro_bias = -seconds * rightJacobian(turn);
  return jacobian;
}

Covariance dense(const PropagationJacobian& jacobian) {
  return timesCovariance(jacobian, Covariance::Identity());
}

void propagate(Estimate& estimate, const Inertial& imu, double seconds, const ImuNoise& noise) {
  const PropagationJacobian jacobian = propagationJacobian(estimate.state, imu, seconds);
  const Covariance half = timesCovariance(jacobian, estimate.covariance).transpose();
  const Covariance product = timesCovariance(jacobian, half);
  estimate.covariance = 0.5 * (product + product.transpose());
  addProcessNoise(estimate.covariance, seconds, noise);
  estimate.state = propagated<double>(estimate.state, imu, seconds, noise.gravity);
}

}  // namespace grid_path_planner::localization
