#include "localization/coasting.h"

#include "localization/imu_propagation.h"

namespace grid_path_planner::localization {

void coast(Estimate& estimate, double seconds, const CoastingNoise& noise) {
  Covariance& covariance = estimate.covariance;
  covariance.middleRows<3>(kPosition) += seconds * covariance.middleRows<3>(kVelocity);
  covariance.middleCols<3>(kPosition) += seconds * covariance.middleCols<3>(kVelocity);
  addProcessNoise(covariance, seconds,
                  {noise.turn, noise.gyro_walk, noise.acceleration, noise.accelerometer_walk, 0.0});
  estimate.state.position += seconds * estimate.state.velocity;
}

}  // namespace grid_path_planner::localization
