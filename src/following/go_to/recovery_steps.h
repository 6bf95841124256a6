// What a vehicle may do when it finds no path to its goal, or cannot go on along it.
#pragma once

#include <string>
#include <vector>

namespace grid_path_planner::following {

enum class RecoveryStep { WAIT, BACK_OFF, TURN_AND_LOOK, PLAN_WITH_TOLERANCE };
// As in the list: "back_off".
const char* toString(RecoveryStep step);

// The steps of a list such as "wait, back_off"; a step may come twice, and an empty list has none. Throws
// InputError naming what is no step. `clear_layer`, which costmaps of several layers know, is refused with
// the reason: projected_map has no layer of a sensor that could be cleared by itself.
std::vector<RecoveryStep> recoverySteps(const std::string& list);

}  // namespace grid_path_planner::following
