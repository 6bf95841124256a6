// Errors of three gyroscopes or accelerometers: white noise, a bias that drifts, and one that is
// drawn when they are switched on.
//
//   NoiseStream noise(seed, SensorName::IMU);
//   DriftingTriad gyroscope(errors, noise);
//   const Eigen::Vector3d error = gyroscope.next(0.01, noise);  // of the mean over the next 10 ms
//
// The drifting bias b is a Gauss-Markov process, db = -b/tau dt + walk dW, that begins at 0; it is
// stepped exactly, so that its statistics do not depend on the rate. White noise of density n has the
// standard deviation n / sqrt(dt) over an interval dt.
#pragma once

#include <Eigen/Core>

#include "simulation/sensors/imu_options.h"
#include "simulation/sensors/noise_stream.h"

namespace grid_path_planner::simulation {

class DriftingTriad {
 public:
  DriftingTriad(const TriadErrors& errors, NoiseStream& noise)
      : errors_(errors), turn_on_(errors.turn_on * noise.normals()) {}

  // The error of the mean over the next `seconds`.
  Eigen::Vector3d next(double seconds, NoiseStream& noise);

  // What all three are off by now, without white noise.
  Eigen::Vector3d bias() const { return turn_on_ + bias_; }
  // Of the white noise of one axis in a mean over `seconds`.
  double variance(double seconds) const { return errors_.noise * errors_.noise / seconds; }
  // Of the integral of one axis' whole error over the first `seconds`.
  double integralVariance(double seconds) const;

 private:
  TriadErrors errors_;
  Eigen::Vector3d turn_on_;
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
};

}  // namespace grid_path_planner::simulation
