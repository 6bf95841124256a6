// What go_to_pose hears, as its navigator takes it.
//
//   checkGoal(goal.target_pose, ZeroHeading::REFUSED);             // throws InputError
//   navigator.planned(navigatorPlanOf(plan, "map"), now);
//   navigator.drove(navigatorDriveOf(feedback), now);
//   const DriverAnswer ended = driverAnswerOf(result);
//   navigator.driveEnded(ended.status, ended.message, now);
//
// Only here the names of statuses in results of actions become statuses.
#pragma once

#include <geometry_msgs/PoseStamped.h>

#include <optional>
#include <string>

#include "following/go_to/navigator.h"
#include "grid_path_planner/NavigatePathFeedback.h"
#include "grid_path_planner/NavigatePathResult.h"
#include "grid_path_planner/PlanPathResult.h"
#include "ros/messages/zero_heading.h"

namespace grid_path_planner::nodes {

// Throws InputError for what checkNetworkText() and readPose() refuse.
void checkGoal(const geometry_msgs::PoseStamped& goal, ZeroHeading zero_heading);

// A path that cannot be driven, or is not in `map_frame`, or a name that is no status, is an answer too: that there
// is none.
following::NavigatorPlan navigatorPlanOf(const PlanPathResult& result,
                                         const std::string& map_frame);

following::NavigatorDrive navigatorDriveOf(const NavigatePathFeedback& feedback);

// How the driver ended, in the words of its answer; no status for a name that is none.
struct DriverAnswer {
  std::optional<following::DriveStatus> status;
  std::string message;
};
DriverAnswer driverAnswerOf(const NavigatePathResult& result);

}  // namespace grid_path_planner::nodes
