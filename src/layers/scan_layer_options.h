// How the scans of a laser become obstacles.
#pragma once

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::layers {

struct ScanLayerOptions {
  double obstacle_max_range = 8.0;  // m
  double clearing_max_range = 8.0;  // m
  double decay_time = 0.0;          // s
  bool inf_clears = false;
};

template <class Visitor>
void visitOptions(ScanLayerOptions& o, Visitor&& visit) {
  visit("obstacle_max_range", o.obstacle_max_range,
        base::OptionInfo{"Hits that are nearer are obstacles, others are not; not above the range "
                         "at which the laser's spread is still small",
                         "m", 0.0, 1000.0}
            .under("The laser"));
  visit("clearing_max_range", o.clearing_max_range,
        base::OptionInfo{"How far along a ray cells are cleared; 0: none are", "m", 0.0, 1000.0});
  visit("decay_time", o.decay_time,
        base::OptionInfo{
            "An obstacle that was not hit for so long is forgotten, so that what moved "
            "on behind the vehicle does not stay; a leap of the clock counts as 10 s; 0: "
            "only rays clear",
            "s", 0.0, 1e6});
  visit("inf_clears", o.inf_clears,
        base::OptionInfo{"Whether a ray without a return (+inf) is free up to clearing_max_range; "
                         "false: it says nothing, as lasers give +inf for black things too",
                         ""});
}

}  // namespace grid_path_planner::layers
