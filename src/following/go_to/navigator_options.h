// How a vehicle gets to a goal: when it plans again, and what it does where it cannot go on.
#pragma once

#include <string>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::following {

struct NavigatorOptions {
  double replan_period = 2.0;  // s
  double replan_hysteresis = 0.1;
  double blocked_timeout = 10.0;  // s
  std::string recovery_steps = "wait, back_off, turn_and_look";
  double recovery_wait = 5.0;       // s
  double back_off_distance = 1.0;   // m
  double recovery_tolerance = 0.5;  // m
};

template <class Visitor>
void visitOptions(NavigatorOptions& o, Visitor&& visit) {
  visit("replan_period", o.replan_period,
        base::OptionInfo{"How often a path is planned while the vehicle drives; 0: only where the "
                         "path ahead is occupied",
                         "s", 0.0, 3600.0}
            .under("Planning again"));
  visit("replan_hysteresis", o.replan_hysteresis,
        base::OptionInfo{"A new path is driven where its length differs from what is left by more "
                         "than this share; larger: steadier",
                         "", 0.0, 10.0});
  visit("blocked_timeout", o.blocked_timeout,
        base::OptionInfo{"Recovery begins when the path ahead has been occupied for so long "
                         "though the planner finds paths",
                         "s", 0.1, 3600.0});
  visit("recovery_steps", o.recovery_steps,
        base::OptionInfo{"What is tried in this order where there is no path, or it cannot go on, "
                         "each once until the vehicle has come nearer to its goal: wait, back_off, "
                         "turn_and_look, plan_with_tolerance, clear_scan; empty: the goal is "
                         "aborted at once",
                         ""}
            .under("Recovery"));
  visit("recovery_wait", o.recovery_wait,
        base::OptionInfo{"How long wait waits before it plans again", "s", 0.0, 3600.0});
  visit("back_off_distance", o.back_off_distance,
        base::OptionInfo{"How far back_off drives back along the driven path", "m", 0.1, 50.0});
  visit("recovery_tolerance", o.recovery_tolerance,
        base::OptionInfo{"How far from the goal a path of plan_with_tolerance may end", "m", 0.01,
                         1000.0});
}

// Throws InputError naming the option for a value outside its limits, and for recovery_steps that hold something else.
void checkNavigatorOptions(const NavigatorOptions& options);

}  // namespace grid_path_planner::following
