// Noise, water and mounting of the simulated pressure sensor.
#pragma once

#include "grid_path_planner/base/options.h"
#include "simulation/sensors/mounting.h"

namespace grid_path_planner::simulation {

struct PressureOptions {
  bool enabled = false;
  double rate = 10.0;             // Hz
  double noise = 200.0;           // Pa
  double surface_z = 7.0;         // m, map frame
  double water_density = 1025.0;  // kg/m^3
  Mounting mounting;
  int seed = 1;
};

template <class Visitor>
void visitOptions(PressureOptions& o, Visitor&& visit) {
  visit("enabled", o.enabled,
        base::OptionInfo{"Whether there is a pressure sensor", ""}.under("The pressure sensor"));
  visit("rate", o.rate,
        base::OptionInfo{"Measurements in a simulated second; at most one a time_step", "Hz", 0.01,
                         10000.0});
  visit("noise", o.noise,
        base::OptionInfo{"Standard deviation; 100 Pa are a centimetre of water", "Pa", 0.0, 1e6});
  visit("surface_z", o.surface_z,
        base::OptionInfo{"Where the surface of the water is, in map_frame", "m", -1e6, 1e6});
  visit("water_density", o.water_density,
        base::OptionInfo{"Fresh water has 1000, the sea 1020 to 1030", "kg/m^3", 1.0, 1e5});
  visitOptions(o.mounting, visit);
  visit("seed", o.seed, base::OptionInfo{"Another seed, other noise", "", 0, 1e9});
}

}  // namespace grid_path_planner::simulation
