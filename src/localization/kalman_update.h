// One update of the extended Kalman filter, in Joseph's form.
//
//   const Innovation<3> innovation(estimate, residual, jacobian, noise);
//   if (innovation.nis() < gate) innovation.apply(estimate);
//
// Guaranteed: the covariance stays symmetric. The error of the attitude is carried over to the
// corrected attitude (reset Jacobian).
#pragma once

#include <Eigen/Cholesky>

#include "localization/measurement_models.h"
#include "localization/state.h"

namespace grid_path_planner::localization {

// Moves the estimate by `error`; the covariance of the attitude's error is turned with it.
void correct(Estimate& estimate, const ErrorVector& error);

template <int N>
class Innovation {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  // `residual`: measured minus predicted. `noise`: positive definite.
  Innovation(const Estimate& estimate, const Vector& residual, const Jacobian<N>& jacobian,
             const Matrix& noise)
      : residual_(residual),
        jacobian_(jacobian),
        noise_(noise),
        projected_(jacobian * estimate.covariance),
        solver_(Matrix(projected_ * jacobian.transpose() + noise)) {}

  // Normalised innovation squared: chi-squared with N degrees of freedom where the model holds.
  double nis() const { return residual_.dot(solver_.solve(residual_)); }

  void apply(Estimate& estimate) const {
    const Eigen::Matrix<double, kErrors, N> gain = solver_.solve(projected_).transpose();
    const Covariance left = estimate.covariance - gain * projected_;
    const Eigen::Matrix<double, kErrors, N> rest = gain * noise_ - left * jacobian_.transpose();
    const Covariance product = left + rest * gain.transpose();
    estimate.covariance = 0.5 * (product + product.transpose());
    correct(estimate, gain * residual_);
  }

 private:
  Vector residual_;
  Jacobian<N> jacobian_;
  Matrix noise_;
  Jacobian<N> projected_;  // jacobian * covariance
  Eigen::LLT<Matrix> solver_;
};

}  // namespace grid_path_planner::localization
