#include "grid_path_planner/ros/path_planner_options.h"

namespace grid_path_planner {

const std::vector<std::pair<const char*, GoalZ>>& choicesOf(GoalZ) {
  static const std::vector<std::pair<const char*, GoalZ>> choices = {{"message", GoalZ::MESSAGE},
                                                                     {"vehicle", GoalZ::VEHICLE}};
  return choices;
}

}  // namespace grid_path_planner
