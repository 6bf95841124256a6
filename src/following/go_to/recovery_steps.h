// What a vehicle may do when it finds no path to its goal, or cannot go on along it.
#pragma once

#include <string>
#include <vector>

namespace grid_path_planner::following {

enum class RecoveryStep { WAIT, BACK_OFF, TURN_AND_LOOK, PLAN_WITH_TOLERANCE, CLEAR_SCAN };
// As in the list: "back_off".
const char* toString(RecoveryStep step);

// The steps of a list such as "wait, back_off"; a step may come twice, and an empty list has none. Throws
// InputError naming what is no step.
std::vector<RecoveryStep> recoverySteps(const std::string& list);

}  // namespace grid_path_planner::following
