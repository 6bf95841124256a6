// Angles, range, noise and mounting of the simulated laser scanner.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"
#include "simulation/sensors/mounting.h"

namespace grid_path_planner::simulation {

// What stands where a ray meets nothing: infinity, as REP 117 has it, or range_max, as older drivers write.
enum class NoReturn { INF, RANGE_MAX };
const std::vector<std::pair<const char*, NoReturn>>& choicesOf(NoReturn);

struct LaserOptions {
  bool enabled = false;
  double rate = 10.0;              // Hz
  double field_of_view = 6.28318;  // rad
  int rays = 360;
  double range_min = 0.12;  // m
  double range_max = 10.0;  // m
  double noise = 0.01;      // m
  double dropout = 0.0;     // probability
  NoReturn no_return = NoReturn::INF;
  Mounting mounting;
  int seed = 1;
};

template <class Visitor>
void visitOptions(LaserOptions& o, Visitor&& visit) {
  using base::OptionInfo;
  visit("enabled", o.enabled,
        OptionInfo{"Whether there is a laser scanner; it needs a world", ""}.under(
            "The laser scanner"));
  visit("rate", o.rate, OptionInfo{"Scans in a simulated second", "Hz", 0.01, 1000.0});
  visit("field_of_view", o.field_of_view,
        OptionInfo{"Angle from the first ray to the last, half of it to either side of ahead; from "
                   "6.28 on the rays stand evenly all around",
                   "rad", 0.01, 6.28319});
  visit("rays", o.rays, OptionInfo{"Rays of a scan", "", 2, 10000});
  visit("range_min", o.range_min,
        OptionInfo{"Nearer surfaces are measured as 0, which is no hit", "m", 0.0, 1e4});
  visit("range_max", o.range_max, OptionInfo{"Farther surfaces are not measured", "m", 0.01, 1e4});
  visit("noise", o.noise, OptionInfo{"Standard deviation of a range", "m", 0.0, 100.0});
  visit(
      "dropout", o.dropout,
      OptionInfo{"Probability that a ray returns nothing though it meets something", "", 0.0, 1.0});
  visit("no_return", o.no_return,
        OptionInfo{"What stands where a ray returns nothing: inf (REP 117), or range_max as older "
                   "drivers write",
                   ""});
  visitOptions(o.mounting, visit);
  visit("seed", o.seed, OptionInfo{"Another seed, other noise and dropouts", "", 0, 1e9});
}

}  // namespace grid_path_planner::simulation
