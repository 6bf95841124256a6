#include "grid_path_planner/simulation/dead_reckoning.h"

#include <cmath>

namespace grid_path_planner::simulation {

DeadReckoning::DeadReckoning(const DeadReckoningOptions& options)
    : options_(options), random_(static_cast<unsigned>(options.odometry_seed)) {}

void DeadReckoning::setOptions(const DeadReckoningOptions& options) {
  if (options.odometry_seed != options_.odometry_seed)
    random_.seed(static_cast<unsigned>(options.odometry_seed));
  options_ = options;
}

void DeadReckoning::reset(const VehicleState& truth) {
  truth_ = truth;
  yaw_error_ = 0.0;
  shift_.setZero();
}

void DeadReckoning::advance(const VehicleState& truth) {
  const double root = std::sqrt((truth.position - truth_.position).norm());
  truth_ = truth;
  const Eigen::Vector3d believed = turned(truth.position) + shift_;
  yaw_error_ += normal(options_.odometry_yaw_drift * root);
  // A new error of the yaw turns what comes, not where the vehicle is now.
  if (options_.odometry_yaw_drift > 0.0) shift_ = believed - turned(truth.position);
  shift_ += shift(options_.odometry_drift * root);
}

VehicleState DeadReckoning::measured() {
  VehicleState state = truth_;
  state.position = turned(truth_.position) + shift_ + shift(options_.odometry_noise);
  state.yaw = truth_.yaw + yaw_error_ + normal(options_.odometry_yaw_noise);
  if (state.yaw != truth_.yaw) state.yaw = std::remainder(state.yaw, 2.0 * M_PI);
  return state;
}

double DeadReckoning::normal(double deviation) {
  if (deviation == 0.0) return 0.0;
  return std::normal_distribution<double>(0.0, deviation)(random_);
}

Eigen::Vector3d DeadReckoning::shift(double deviation) {
  const double x = normal(deviation);
  const double y = normal(deviation);
  return {x, y, normal(deviation)};
}

Eigen::Vector3d DeadReckoning::turned(const Eigen::Vector3d& p) const {
  const double c = std::cos(yaw_error_);
  const double s = std::sin(yaw_error_);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()};
}

}  // namespace grid_path_planner::simulation
