// Random numbers of one sensor: a sequence that its seed and its number among the sensors give.
//
//   NoiseStream noise(options.seed, SensorName::IMU);
//   const double measured = truth + options.noise * noise.normal();
//
// Guaranteed: the same seed and sensor give the same numbers; different ones numbers that are as
// good as independent, so that sensors with one seed do not err alike. A sensor draws whether or not
// a deviation is 0: switching one noise off leaves the others as they are.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "simulation/range_noise.h"
#include "simulation/sensors/sensor_name.h"

namespace grid_path_planner::simulation {

class NoiseStream {
 public:
  NoiseStream(int seed, SensorName sensor)
      : key_(mixed(mixed(static_cast<std::uint64_t>(seed)) ^ static_cast<std::uint64_t>(sensor))) {}

  // Even in [0, 1).
  double even() { return static_cast<double>(mixed(key_ + drawn_++) >> 11) * 0x1p-53; }

  // Mean 0, standard deviation 1 (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log1p(-even()));
    return radius * std::cos(2.0 * M_PI * even());
  }

  // Three independent ones.
  Eigen::Vector3d normals() {
    const double x = normal(), y = normal();
    return {x, y, normal()};
  }

 private:
  std::uint64_t key_;
  std::uint64_t drawn_ = 0;
};

}  // namespace grid_path_planner::simulation
