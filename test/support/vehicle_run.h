// A simulated vehicle that is driven for a while.
#pragma once

#include <cmath>

#include "grid_path_planner/simulation/vehicle.h"

namespace grid_path_planner::test {

inline void run(simulation::Vehicle& vehicle, const base::BodyVelocity& velocity, double seconds) {
  const int steps = static_cast<int>(std::lround(seconds / vehicle.options().time_step));
  for (int i = 0; i < steps; ++i) {
    vehicle.command(velocity);
    vehicle.step();
  }
}

}  // namespace grid_path_planner::test
