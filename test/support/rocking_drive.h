// A drive to test sensors on: random commands, and a vehicle that rolls and pitches.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "grid_path_planner/simulation/vehicle.h"

namespace grid_path_planner::test {

inline simulation::VehicleOptions rocking() {
  simulation::VehicleOptions options;
  options.roll_amplitude = 0.12;
  options.roll_period = 3.0;
  options.pitch_amplitude = 0.08;
  options.pitch_period = 4.3;
  return options;
}

// Calls `after_step(vehicle)` after each step of `seconds`, with a new command every second.
template <class AfterStep>
void drive(simulation::Vehicle& vehicle, double seconds, int seed, const AfterStep& after_step) {
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto upTo = [&random](double most) {
    return most * (static_cast<double>(random()) / 2147483648.0 - 1.0);
  };
  const auto steps = static_cast<int>(std::lround(seconds / vehicle.options().time_step));
  const auto steps_a_command = static_cast<int>(std::lround(1.0 / vehicle.options().time_step));
  base::BodyVelocity command;
  for (int i = 0; i < steps; ++i) {
    if (i % steps_a_command == 0) command = {upTo(1.0), upTo(0.6), upTo(0.4), upTo(0.8)};
    vehicle.command(command);
    vehicle.step();
    after_step(vehicle);
  }
}

inline double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// About the mean.
inline double varianceOf(const std::vector<double>& values) {
  const double mean = meanOf(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(values.size() - 1);
}

}  // namespace grid_path_planner::test
