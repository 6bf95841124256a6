#include "ros/driving/go_to_messages.h"

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/conversions.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

using base::InputError;
using following::Navigator;
using following::NavigatorDrive;
using following::NavigatorPlan;

namespace {

NavigatorDrive::State stateOf(const NavigatePathFeedback& feedback) {
  if (feedback.state == "paused") return NavigatorDrive::State::PAUSED;
  if (feedback.state != "blocked") return NavigatorDrive::State::DRIVING;
  return feedback.obstructed ? NavigatorDrive::State::OBSTRUCTED : NavigatorDrive::State::HELD;
}

}  // namespace

void checkGoal(const geometry_msgs::PoseStamped& goal) {
  checkNetworkText("the frame of the goal", goal.header.frame_id);
  poseFromMessage(goal.pose);
}

NavigatorPlan navigatorPlanOf(const PlanPathResult& result, const std::string& map_frame) {
  NavigatorPlan plan{result.status, result.message};
  if (result.status != "FOUND") return plan;
  try {
    plan.path = pathFromMessage(result.path);
    plan.path.frame_id = frameInMap(plan.path.frame_id, map_frame);
    if (plan.path.frame_id != frameName(map_frame))
      throw InputError("it is in the frame '" + plan.path.frame_id + "', map_frame is '" +
                       map_frame + "'");
    return plan;
  } catch (const InputError& error) {
    return {Navigator::kNoAnswer, std::string("the planner's path is refused: ") + error.what()};
  }
}

NavigatorDrive navigatorDriveOf(const NavigatePathFeedback& feedback) {
  return {stateOf(feedback), feedback.distance_remaining_m, feedback.message};
}

}  // namespace grid_path_planner::nodes
