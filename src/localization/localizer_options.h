// The options of the two filters of a vehicle, and when its pose is not to be relied on.
#pragma once

#include "localization/filter_options.h"

namespace grid_path_planner::localization {

struct LocalizerOptions {
  FilterOptions filter;
  double max_deviation = 1.0;  // m
  double max_angle = 12.0;     // deg
  double input_timeout = 3.0;  // s
  double fix_timeout = 60.0;   // s; 0: never
  double reset_doubt = 60.0;   // s
};

template <class Visitor>
void visitOptions(LocalizerOptions& o, Visitor&& visit) {
  using base::OptionInfo;
  visitOptions(o.filter, visit);
  visit("max_deviation", o.max_deviation,
        OptionInfo{"Above this standard deviation of the position, along its worst axis, the "
                   "vehicle is LOST and map -> odom ceases; above a third of it, DEGRADED",
                   "m", 0.01, 1000.0}
            .under("When the pose is not to be relied on"));
  visit("max_angle", o.max_angle, OptionInfo{"The same for the attitude", "deg", 0.1, 180.0});
  visit("input_timeout", o.input_timeout,
        OptionInfo{"DEGRADED while DVL or depth have been silent or rejected for so long, once "
                   "they were used, or USBL for five times as long",
                   "s", 0.1, 3600.0});
  visit(
      "fix_timeout", o.fix_timeout,
      OptionInfo{"LOST when no fix (USBL, marker pose, heading, a pose that was set) has been used "
                 "for so long, whatever the standard deviations say, and DEGRADED after a third of "
                 "it: without fixes nothing shows what they leave out; 0: never",
                 "s", 0.0, 86400.0});
  visit("reset_doubt", o.reset_doubt,
        OptionInfo{"DEGRADED for so long after rejected measurements that agree began anew what "
                   "they measure (reset_after), unless they told the position and a fix of another "
                   "kind confirms it: it may have been they that were wrong; 0: not",
                   "s", 0.0, 86400.0});
}

}  // namespace grid_path_planner::localization
