// Acoustic positioning (ultra-short baseline): a vessel's transceiver measures distance and direction of
// a transponder on the vehicle, and sends what it found down to it.
//
//   Usbl usbl(options);
//   for (const UsblFix& fix : usbl.measure(vehicle.state(), vehicle.timeNs()))   // after every step
//     std::cout << fix.position.transpose() << "\n";
//
// A fix is of the transponder's place in the map. It is stamped with the time at which the transponder
// was there, and arrives `delay` and the sound's travel later. Guaranteed: the same calls give the same
// fixes, bit for bit. Not modelled: a vessel that moves, echoes, obstacles between the two, the
// refraction of the sound.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "grid_path_planner/simulation/vehicle.h"
#include "simulation/sensors/noise_stream.h"
#include "simulation/sensors/sample_clock.h"
#include "simulation/sensors/usbl_options.h"

namespace grid_path_planner::simulation {

struct UsblFix {
  std::int64_t time_ns = 0;                            // when it was valid
  std::int64_t arrives_ns = 0;                         // when the vehicle knows it
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m, map frame
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

class Usbl {
 public:
  explicit Usbl(const UsblOptions& options);

  const UsblOptions& options() const { return options_; }

  // The vehicle is at `state` after a step. What has arrived by now, in the order in which it was
  // measured.
  std::vector<UsblFix> measure(const VehicleState& state, std::int64_t time_ns);

 private:
  UsblFix fixOf(const Eigen::Vector3d& transponder, std::int64_t time_ns);
  Eigen::Vector3d outlier();

  UsblOptions options_;
  Eigen::Vector3d keel_;
  SampleClock clock_;
  NoiseStream noise_;
  std::vector<UsblFix> travelling_;
};

}  // namespace grid_path_planner::simulation
