#include "localization/kalman_update.h"

namespace grid_path_planner::localization {

void correct(Estimate& estimate, const ErrorVector& error) {
  const Eigen::Matrix3d reset = rightJacobian(error.segment<3>(kAttitude));
  Covariance& covariance = estimate.covariance;
  covariance.middleRows<3>(kAttitude) = (reset * covariance.middleRows<3>(kAttitude)).eval();
  covariance.middleCols<3>(kAttitude) =
      (covariance.middleCols<3>(kAttitude) * reset.transpose()).eval();
  estimate.state = retract<double>(estimate.state, error);
  estimate.state.attitude.normalize();
}

}  // namespace grid_path_planner::localization
