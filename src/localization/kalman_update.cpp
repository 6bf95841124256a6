#include "localization/kalman_update.h"

#include "base/cholesky.h"

namespace grid_path_planner::localization {

namespace {

// The columns of attitude and velocity: `up` in the body is the axis that `velocity` is the arm of.
template <class Matrix>
void carryOver(const Eigen::Matrix3d& attitude, const Eigen::Vector3d& velocity,
               const Eigen::Vector3d& up, Matrix&& covariance) {
  const Eigen::Matrix<double, kErrors, 3> turn = covariance.template middleCols<3>(kAttitude);
  const ErrorVector heading = turn * up;
  covariance.template middleCols<3>(kVelocity).noalias() += heading * velocity.transpose();
  covariance.template middleCols<3>(kAttitude).noalias() = turn * attitude.transpose();
}

}  // namespace

void correct(Estimate& estimate, const ErrorVector& error) {
  const State before = estimate.state;
  State& after = estimate.state;
  after = retract<double>(before, error);
  after.attitude.normalize();
  const Eigen::Matrix3d to_world = before.attitude.toRotationMatrix();
  const Eigen::Matrix3d attitude = after.attitude.toRotationMatrix().transpose() * to_world;
  const Eigen::Vector3d velocity = Eigen::Vector3d::UnitZ().cross(after.velocity - before.velocity);
  carryOver(attitude, velocity, to_world.row(2), estimate.covariance.transpose());
  carryOver(attitude, velocity, to_world.row(2), estimate.covariance);
}

namespace {

// matrix * row^T, most of whose entries are 0.
ErrorVector timesRow(const Covariance& matrix, const ErrorVector& row) {
  ErrorVector product = ErrorVector::Zero();
  for (int i = 0; i < kErrors; ++i)
    if (row[i] != 0.0) product += row[i] * matrix.col(i);
  return product;
}

}  // namespace

// Rows that the measurement has not are as if their residual were 0 and told nothing.
void Innovation::project(const Covariance& covariance) {
  Eigen::Matrix<double, kMost, kMost> of_innovation = noise_;
  for (int i = 0; i < size_; ++i) {
    projected_[i] = timesRow(covariance, jacobian_[i]);
    for (int k = 0; k <= i; ++k) of_innovation(i, k) += jacobian_[k].dot(projected_[i]);
  }
  const base::Cholesky<kMost> factor(of_innovation);
  information_ = factor.inverse();
  weighted_ = factor.solved(residual_);
}

// gain = P H^T S^-1; left = P - gain H P; P := left + (gain R - left H^T) gain^T
void Innovation::apply(Estimate& estimate) const {
  Columns gain, rest;
  ErrorVector correction = ErrorVector::Zero();
  for (int i = 0; i < size_; ++i) {
    gain[i].setZero();
    for (int k = 0; k < size_; ++k) gain[i] += information_(k, i) * projected_[k];
    correction += weighted_[i] * projected_[i];
  }
  Covariance product = estimate.covariance;
  for (int column = 0; column < kErrors; ++column)
    for (int i = 0; i < size_; ++i) product.col(column) -= projected_[i][column] * gain[i];
  for (int i = 0; i < size_; ++i) {
    rest[i] = -timesRow(product, jacobian_[i]);
    for (int k = 0; k < size_; ++k) rest[i] += noise_(k, i) * gain[k];
  }
  for (int column = 0; column < kErrors; ++column)
    for (int i = 0; i < size_; ++i) product.col(column) += gain[i][column] * rest[i];
  estimate.covariance = 0.5 * (product + product.transpose());
  correct(estimate, correction);
}

}  // namespace grid_path_planner::localization
