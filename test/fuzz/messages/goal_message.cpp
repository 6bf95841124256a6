// A request for a plan as the services, the action and the topics of path_planner make it.
#include <nav_msgs/GetPlan.h>
#include <std_msgs/String.h>

#include <cmath>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/planning/path_planner.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/planning/planning_request.h"

namespace grid_path_planner::fuzz {
namespace {

geometry_msgs::PoseStamped poseAt(double x, double y) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "map";
  pose.pose.position.x = x;
  pose.pose.position.y = y;
  pose.pose.orientation.w = 1.0;
  return pose;
}

std::string requestFor(const std::string& planner, double x, double y) {
  std_msgs::String name;
  name.data = planner;
  nav_msgs::GetPlan::Request request;
  request.start = poseAt(0.5, 0.5);
  request.goal = poseAt(x, y);
  request.tolerance = 0.5f;
  return bytesOf(name) + bytesOf(name) + bytesOf(request);
}

std::vector<std::string> seedsOfRequests() {
  return {requestFor("", 7.5, 5.5), requestFor("a_star", 1e300, 0.5), requestFor("anya", 4.5, 2.5),
          requestFor("incremental_a_star", 7.5, 0.5)};
}

std::shared_ptr<const grid::OccupancyGrid> mapWithAWall() {
  auto map = std::make_shared<grid::OccupancyGrid>(grid::GridGeometry(8, 6, 1.0));
  for (int row = 0; row < 4; ++row) (*map)[{4, row}] = 100;
  return map;
}

// Poses that tf moved are beyond the limits of messages, so these are asked of the message alone.
path::Pose anyPose(const geometry_msgs::Pose& message) {
  path::Pose pose;
  mayRefuse([&] { pose = nodes::poseFromMessage(message); });
  pose.position = {message.position.x, message.position.y, message.position.z};
  return pose;
}

void checkPlan(const planning::Plan& plan) {
  mustHold(plan.found() == !plan.path.poses.empty(), "a plan has a path where it was found");
  for (const path::Pose& pose : plan.path.poses)
    mustHold(pose.position.allFinite() && std::isfinite(pose.yaw), "poses are finite");
}

FUZZ_TARGET(goal_message, seedsOfRequests) {
  Messages messages(input);
  const auto planner = messages.next<std_msgs::String>();
  const auto heuristic = messages.next<std_msgs::String>();
  const auto asked = messages.next<nav_msgs::GetPlan::Request>();
  if (!planner || !heuristic || !asked) return;
  nodes::PlanningRequest request;
  request.start = asked->start;
  request.goal = asked->goal;
  request.planner = planner->data;
  request.heuristic = heuristic->data;
  request.tolerance = asked->tolerance;
  mayRefuse([&] {
    nodes::checkText(request);
    planning::PathPlanner path_planner(nodes::optionsFor(request, {}));
    path_planner.setMap(mapWithAWall());
    checkPlan(path_planner.plan({anyPose(request.start->pose), anyPose(request.goal.pose)}));
  });
  nodes::checkText(nodes::printable(request));
}

}  // namespace
}  // namespace grid_path_planner::fuzz
