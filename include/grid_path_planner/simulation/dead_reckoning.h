// Odometry with errors: the true pose, turned and shifted by drift that grows with the distance.
//
//   DeadReckoning odometry(options);
//   odometry.advance(vehicle.state());                   // after every step
//   const VehicleState measured = odometry.measured();
//
// Drift is a random walk: its standard deviation grows with the square root of the distance driven,
// so that the measured pose of a standing vehicle does not drift. Noise is independent in every
// measurement and does not accumulate. Guaranteed: with all options 0 the measured state is the true one,
// bit for bit; the same options and states give the same measurements. The velocity is always the
// true one.
#pragma once

#include <random>

#include "grid_path_planner/base/options.h"
#include "grid_path_planner/simulation/vehicle.h"

namespace grid_path_planner::simulation {

struct DeadReckoningOptions {
  double odometry_noise = 0.0;      // m
  double odometry_yaw_noise = 0.0;  // rad
  double odometry_drift = 0.0;      // m / sqrt(m)
  double odometry_yaw_drift = 0.0;  // rad / sqrt(m)
  int odometry_seed = 1;
};

template <class Visitor>
void visitOptions(DeadReckoningOptions& o, Visitor&& visit) {
  visit("odometry_noise", o.odometry_noise,
        base::OptionInfo{"Standard deviation of each coordinate in every measurement of odometry",
                         "m", 0.0, 100.0}
            .under("Odometry and tf odom to base_link; all 0: they are the truth"));
  visit("odometry_yaw_noise", o.odometry_yaw_noise,
        base::OptionInfo{"Standard deviation of the yaw in every measurement of odometry", "rad",
                         0.0, 3.0});
  visit("odometry_drift", o.odometry_drift,
        base::OptionInfo{
            "Standard deviation of each coordinate of odometry after the first metre; it "
            "grows with the square root of the distance",
            "m", 0.0, 100.0});
  visit("odometry_yaw_drift", o.odometry_yaw_drift,
        base::OptionInfo{
            "Standard deviation of the yaw of odometry after the first metre; it grows with "
            "the square root of the distance",
            "rad", 0.0, 3.0});
  visit(
      "odometry_seed", o.odometry_seed,
      base::OptionInfo{"What all noise is drawn from; another one gives another run", "", 0, 1e9});
}

class DeadReckoning {
 public:
  explicit DeadReckoning(const DeadReckoningOptions& options = {});

  // From the next `advance` on; the drift so far stays, and a new seed begins a new series.
  void setOptions(const DeadReckoningOptions& options);

  // No drift, and the vehicle is at `truth` without having driven there.
  void reset(const VehicleState& truth);

  // The vehicle has driven from the state before to `truth`.
  void advance(const VehicleState& truth);

  // With noise that is new in every call.
  VehicleState measured();

 private:
  double normal(double deviation);
  Eigen::Vector3d shift(double deviation);
  Eigen::Vector3d turned(const Eigen::Vector3d& position) const;

  DeadReckoningOptions options_;
  std::mt19937 random_;
  VehicleState truth_;
  double yaw_error_ = 0.0;                           // rad; measured minus true
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();  // m, after the turn about the origin
};

}  // namespace grid_path_planner::simulation
