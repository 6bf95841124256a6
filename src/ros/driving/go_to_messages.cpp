#include "ros/driving/go_to_messages.h"

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/ros/conversions.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/network_text.h"
#include "ros/messages/pose_reading.h"

namespace grid_path_planner::nodes {

using base::InputError;
using following::NavigatorDrive;
using following::NavigatorPlan;

namespace {

NavigatorDrive::State stateOf(const NavigatePathFeedback& feedback) {
  if (feedback.state == "paused") return NavigatorDrive::State::PAUSED;
  if (feedback.state != "blocked") return NavigatorDrive::State::DRIVING;
  return feedback.obstructed ? NavigatorDrive::State::OBSTRUCTED : NavigatorDrive::State::HELD;
}

template <class Result>
std::string unknownStatus(const Result& result) {
  return "the status '" + printable(result.status) + "' is not known: " + result.message;
}

}  // namespace

void checkGoal(const geometry_msgs::PoseStamped& goal, ZeroHeading zero_heading) {
  checkNetworkText("the frame of the goal", goal.header.frame_id);
  readPose(goal.pose, zero_heading);
}

NavigatorPlan navigatorPlanOf(const PlanPathResult& result, const std::string& map_frame) {
  const auto status = base::statusFromName(result.status);
  NavigatorPlan plan{status, status ? result.message : unknownStatus(result)};
  if (status != base::Status::FOUND) return plan;
  try {
    plan.path = pathFromMessage(result.path);
    plan.path.frame_id = frameInMap(plan.path.frame_id, map_frame);
    if (plan.path.frame_id != frameName(map_frame))
      throw InputError("it is in the frame '" + plan.path.frame_id + "', map_frame is '" +
                       map_frame + "'");
    return plan;
  } catch (const InputError& error) {
    return {std::nullopt, std::string("the planner's path is refused: ") + error.what()};
  }
}

NavigatorDrive navigatorDriveOf(const NavigatePathFeedback& feedback) {
  return {stateOf(feedback), feedback.distance_remaining_m, feedback.message};
}

DriverAnswer driverAnswerOf(const NavigatePathResult& result) {
  const auto status = following::driveStatusFromName(result.status);
  return {status, status ? result.message : unknownStatus(result)};
}

}  // namespace grid_path_planner::nodes
