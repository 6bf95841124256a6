#include "localization/state.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace grid_path_planner::localization {

bool isFinite(const Estimate& estimate) {
  const State& state = estimate.state;
  return state.position.allFinite() && state.velocity.allFinite() &&
         state.attitude.coeffs().allFinite() && state.gyro_bias.allFinite() &&
         state.accelerometer_bias.allFinite() && estimate.covariance.allFinite();
}

double worstDeviation(const Covariance& covariance, int first) {
  const Eigen::Matrix3d block = covariance.block<3, 3>(first, first);
  if (!block.allFinite()) return std::numeric_limits<double>::infinity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(block, Eigen::EigenvaluesOnly);
  const double variance = solver.eigenvalues().maxCoeff();
  if (std::isnan(variance)) return std::numeric_limits<double>::infinity();
  return std::sqrt(std::max(0.0, variance));
}

Mounting inverse(const Mounting& mounting) {
  const Eigen::Quaterniond back = mounting.rotation.conjugate();
  return {-(back * mounting.position), back};
}

Mounting operator*(const Mounting& outer, const Mounting& inner) {
  return {outer.position + outer.rotation * inner.position, outer.rotation * inner.rotation};
}

double yawOf(const Eigen::Quaterniond& attitude) {
  const Eigen::Vector3d forward = attitude * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

}  // namespace grid_path_planner::localization
