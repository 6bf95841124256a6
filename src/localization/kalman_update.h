// One update of the extended Kalman filter, in Joseph's form.
//
//   const Innovation innovation(estimate, residual, jacobian, noise);
//   if (innovation.nis() < gate) innovation.apply(estimate);
//
// Guaranteed: the covariance stays symmetric.
#pragma once

#include <array>

#include "localization/measurement_models.h"
#include "localization/state.h"

namespace grid_path_planner::localization {

// Moves the estimate by `error`. The covariance is carried over to the corrected state with the turn in the
// world kept: an unknown heading is one turn of attitude and velocity together, by the velocity of now. As if it
// were a turn of the values before, a DVL would seem to measure the heading by each correction of the velocity.
void correct(Estimate& estimate, const ErrorVector& error);

// Of a measurement of one to six numbers. Whatever their number, the same code: sums of columns of 15.
class Innovation {
 public:
  // `residual`: measured minus predicted. `noise`: positive definite.
  template <int N>
  Innovation(const Estimate& estimate, const Eigen::Matrix<double, N, 1>& residual,
             const Jacobian<N>& jacobian, const Eigen::Matrix<double, N, N>& noise)
      : size_(N) {
    static_assert(N <= kMost);
    residual_.head<N>() = residual;
    noise_.topLeftCorner<N, N>() = noise;
    for (int row = 0; row < N; ++row) jacobian_[row] = jacobian.row(row).transpose();
    project(estimate.covariance);
  }

  int size() const { return size_; }
  // Those behind the first size() are 0.
  const Eigen::Matrix<double, 6, 1>& residual() const { return residual_; }

  // Normalised innovation squared: chi-squared with size() degrees of freedom where the model holds.
  double nis() const { return residual_.dot(weighted_); }

  void apply(Estimate& estimate) const;

  // For another covariance of the same state.
  void project(const Covariance& covariance);

 private:
  static constexpr int kMost = 6;
  using Columns = std::array<ErrorVector, kMost>;

  int size_;
  Eigen::Matrix<double, kMost, 1> residual_ = Eigen::Matrix<double, kMost, 1>::Zero();
  Eigen::Matrix<double, kMost, kMost> noise_ = Eigen::Matrix<double, kMost, kMost>::Identity();
  Columns jacobian_;                                 // its rows
  Columns projected_;                                // covariance * jacobian^T
  Eigen::Matrix<double, kMost, kMost> information_;  // of the innovation: its covariance's inverse
  Eigen::Matrix<double, kMost, 1> weighted_;         // information * residual
};

}  // namespace grid_path_planner::localization
