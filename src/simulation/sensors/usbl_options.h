// Errors, delay and places of the simulated acoustic positioning.
#pragma once

#include "grid_path_planner/base/options.h"
#include "simulation/sensors/mounting.h"

namespace grid_path_planner::simulation {

struct UsblOptions {
  bool enabled = false;
  double rate = 1.0;    // Hz
  double keel_x = 9.9;  // m, map frame: the vessel of worlds/dexrov_site.sdf
  double keel_y = -0.4;
  double keel_z = 5.6;
  double range_noise = 0.1;          // m
  double bearing_noise = 0.0174533;  // rad, 1 degree
  double delay = 0.6;                // s
  double sound_speed = 1500.0;       // m/s
  double outlier_share = 0.05;
  double outlier_min = 2.0;   // m
  double outlier_max = 20.0;  // m
  Mounting mounting;
  int seed = 1;
};

template <class Visitor>
void visitOptions(UsblOptions& o, Visitor&& visit) {
  visit("enabled", o.enabled,
        base::OptionInfo{"Whether a vessel measures where the vehicle is", ""}.under(
            "Acoustic positioning (USBL)"));
  visit(
      "rate", o.rate,
      base::OptionInfo{"Fixes in a simulated second; at most one a time_step", "Hz", 0.01, 100.0});
  visit("keel_x", o.keel_x,
        base::OptionInfo{"Where the vessel's transceiver is, in map_frame", "m", -1e6, 1e6});
  visit("keel_y", o.keel_y,
        base::OptionInfo{"Where the vessel's transceiver is, in map_frame", "m", -1e6, 1e6});
  visit("keel_z", o.keel_z,
        base::OptionInfo{"Where the vessel's transceiver is, upwards", "m", -1e6, 1e6});
  visit("range_noise", o.range_noise,
        base::OptionInfo{"Standard deviation of the distance", "m", 0.0, 1000.0});
  visit("bearing_noise", o.bearing_noise,
        base::OptionInfo{"Standard deviation of the direction, in each of two", "rad", 0.0, 1.0});
  visit("delay", o.delay,
        base::OptionInfo{"A fix arrives so long after the time it is stamped with, and the time "
                         "that sound takes to the vessel",
                         "s", 0.0, 60.0});
  visit("sound_speed", o.sound_speed,
        base::OptionInfo{"How fast sound travels in the water", "m/s", 100.0, 10000.0});
  visit("outlier_share", o.outlier_share,
        base::OptionInfo{"Probability that a fix is elsewhere, which its covariance does not tell",
                         "", 0.0, 1.0});
  visit("outlier_min", o.outlier_min,
        base::OptionInfo{"Least distance of such a fix from where it belongs", "m", 0.0, 1e6});
  visit("outlier_max", o.outlier_max,
        base::OptionInfo{"Largest distance of such a fix from where it belongs", "m", 0.0, 1e6});
  visitOptions(o.mounting, visit);
  visit("seed", o.seed, base::OptionInfo{"Another seed, other noise and outliers", "", 0, 1e9});
}

}  // namespace grid_path_planner::simulation
