// What go_to_pose hears, as its navigator takes it.
//
//   checkGoal(goal.target_pose);                                   // throws InputError
//   navigator.planned(navigatorPlanOf(result, "map"), now);
//   navigator.drove(navigatorDriveOf(feedback), now);
#pragma once

#include <geometry_msgs/PoseStamped.h>

#include <string>

#include "following/go_to/navigator.h"
#include "grid_path_planner/NavigatePathFeedback.h"
#include "grid_path_planner/PlanPathResult.h"

namespace grid_path_planner::nodes {

// Throws InputError for what checkNetworkText() and poseFromMessage() refuse.
void checkGoal(const geometry_msgs::PoseStamped& goal);

// A path that cannot be driven, or is not in `map_frame`, is an answer too: that there is none.
following::NavigatorPlan navigatorPlanOf(const PlanPathResult& result,
                                         const std::string& map_frame);

following::NavigatorDrive navigatorDriveOf(const NavigatePathFeedback& feedback);

}  // namespace grid_path_planner::nodes
