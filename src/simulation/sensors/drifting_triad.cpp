#include "simulation/sensors/drifting_triad.h"

#include <algorithm>
#include <cmath>

namespace grid_path_planner::simulation {

Eigen::Vector3d DriftingTriad::next(double seconds, NoiseStream& noise) {
  const double tau = errors_.correlation_time;
  const double driven = errors_.walk * std::sqrt(-0.5 * tau * std::expm1(-2.0 * seconds / tau));
  bias_ = std::exp(-seconds / tau) * bias_ + driven * noise.normals();
  return turn_on_ + bias_ + std::sqrt(variance(seconds)) * noise.normals();
}

// The integral of the Gauss-Markov process is that of walk * tau * (1 - exp(-(t - u) / tau)) dW(u).
double DriftingTriad::integralVariance(double seconds) const {
  const double tau = errors_.correlation_time;
  const double wandering = seconds + 2.0 * tau * std::expm1(-seconds / tau) -
                           0.5 * tau * std::expm1(-2.0 * seconds / tau);
  return errors_.turn_on * errors_.turn_on * seconds * seconds +
         errors_.noise * errors_.noise * seconds +
         errors_.walk * errors_.walk * tau * tau * std::max(0.0, wandering);
}

}  // namespace grid_path_planner::simulation
