// Beams, errors, rate and mounting of the simulated Doppler velocity log.
#pragma once

#include "grid_path_planner/base/options.h"
#include "simulation/sensors/mounting.h"

namespace grid_path_planner::simulation {

// Under the vehicle.
inline Mounting dvlMounting() {
  Mounting mounting;
  mounting.z = -0.2;
  return mounting;
}

struct DvlOptions {
  bool enabled = false;
  double rate = 7.0;              // Hz
  double beam_angle = 0.5235988;  // rad, 30 degrees
  double beam_noise = 0.005;      // m/s
  double range_min = 0.7;         // m
  double range_max = 90.0;        // m
  double scale_error = 0.0;
  double misalignment = 0.0;  // rad
  Mounting mounting = dvlMounting();
  int seed = 1;
};

template <class Visitor>
void visitOptions(DvlOptions& o, Visitor&& visit) {
  visit("enabled", o.enabled,
        base::OptionInfo{"Whether there is a Doppler velocity log; it needs a world", ""}.under(
            "The Doppler velocity log (DVL)"));
  visit("rate", o.rate,
        base::OptionInfo{"Measurements in a simulated second; at most one a time_step", "Hz", 0.01,
                         10000.0});
  visit("beam_angle", o.beam_angle,
        base::OptionInfo{"Angle of the four beams off the sensor's axis down, two ahead and two "
                         "astern; larger: horizontal velocities are more exact",
                         "rad", 0.05, 1.4});
  visit("beam_noise", o.beam_noise,
        base::OptionInfo{"Standard deviation of the velocity along each beam", "m/s", 0.0, 10.0});
  visit("range_min", o.range_min,
        base::OptionInfo{"A beam that meets something nearer is lost", "m", 0.0, 1000.0});
  visit("range_max", o.range_max,
        base::OptionInfo{"A beam that meets nothing nearer is lost; with less than three beams "
                         "there is no velocity",
                         "m", 0.01, 1000.0});
  visit("scale_error", o.scale_error,
        base::OptionInfo{"What velocities are too large by, which no covariance tells, as for a "
                         "wrong speed of sound",
                         "", -0.5, 0.5});
  visit("misalignment", o.misalignment,
        base::OptionInfo{"Turn about z between the sensor and where tf has it, which nothing tells",
                         "rad", -3.2, 3.2});
  visitOptions(o.mounting, visit);
  visit("seed", o.seed, base::OptionInfo{"Another seed, other noise", "", 0, 1e9});
}

}  // namespace grid_path_planner::simulation
