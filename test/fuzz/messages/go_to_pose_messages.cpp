// What go_to_pose hears: goals, and what planner and driver answer.
#include <move_base_msgs/MoveBaseGoal.h>

#include <cmath>
#include <utility>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/NavigatePathResult.h"
#include "grid_path_planner/ros/conversions.h"
#include "ros/driving/go_to_messages.h"
#include "ros/guard/action/action_stamps.h"
#include "ros/guard/action/goals_of_status.h"

namespace grid_path_planner::fuzz {
namespace {

using following::Navigator;
using following::NavigatorOrder;

constexpr int kMostHeard = 16;
enum Heard { PLAN_RESULT, FEEDBACK, DRIVE_RESULT, VEHICLE, CANCEL, ABORT, GOAL, TICK, kHeard };

geometry_msgs::Pose poseAtX(double x) {
  geometry_msgs::Pose pose;
  pose.position.x = x;
  pose.orientation.w = 1.0;
  return pose;
}

std::string heard(Heard what, const std::string& message = "") {
  return static_cast<char>(what) + message;
}

std::string goalTo(double x) {
  move_base_msgs::MoveBaseGoal goal;
  goal.target_pose.header.frame_id = "map";
  goal.target_pose.pose = poseAtX(x);
  return heard(GOAL, bytesOf(goal));
}

std::string pathFound() {
  PlanPathResult result;
  result.status = "FOUND";
  result.path.header.frame_id = "map";
  result.path.poses.resize(2);
  result.path.poses[0].pose = poseAtX(0.0);
  result.path.poses[1].pose = poseAtX(2.0);
  return heard(PLAN_RESULT, bytesOf(result));
}

std::string drives(const std::string& state, bool obstructed) {
  NavigatePathFeedback feedback;
  feedback.state = state;
  feedback.obstructed = obstructed;
  feedback.distance_remaining_m = 1.0;
  return heard(FEEDBACK, bytesOf(feedback));
}

std::string driveEnds(const std::string& status) {
  NavigatePathResult result;
  result.status = status;
  return heard(DRIVE_RESULT, bytesOf(result));
}

std::vector<std::string> seedsOfGoals() {
  const std::string begin = goalTo(2.0) + heard(VEHICLE, bytesOf(poseAtX(0.0))) + pathFound();
  PlanPathResult none;
  none.status = "UNREACHABLE";
  return {begin + drives("driving", false) + driveEnds("ARRIVED"),
          begin + drives("blocked", true) + heard(TICK) + pathFound() + driveEnds("BLOCKED"),
          begin + heard(PLAN_RESULT, bytesOf(none)) + heard(TICK) + heard(CANCEL),
          goalTo(2.0) + heard(PLAN_RESULT, bytesOf(none)) + heard(TICK) + heard(ABORT)};
}

void driveEnded(Navigator& navigator, const nodes::DriverAnswer& answer, double now) {
  navigator.driveEnded(answer.status, answer.message, now);
}

void hear(Messages& messages, Navigator& navigator, double now, int& ends) {
  switch (messages.byte() % kHeard) {
    case PLAN_RESULT:
      if (const auto result = messages.next<PlanPathResult>())
        navigator.planned(nodes::navigatorPlanOf(*result, "map"), now);
      return;
    case FEEDBACK:
      if (const auto feedback = messages.next<NavigatePathFeedback>())
        navigator.drove(nodes::navigatorDriveOf(*feedback), now);
      return;
    case DRIVE_RESULT:
      if (const auto result = messages.next<NavigatePathResult>())
        driveEnded(navigator, nodes::driverAnswerOf(*result), now);
      return;
    case VEHICLE:  // tf says it, and knows no limits
      if (const auto pose = messages.next<geometry_msgs::Pose>())
        navigator.moved({{pose->position.x, pose->position.y, pose->position.z},
                         nodes::yawOf(pose->orientation)});
      return;
    case CANCEL:
      return navigator.cancel("cancelled", now);
    case ABORT:
      return navigator.abort("aborted", now);
    case GOAL:
      if (const auto goal = messages.next<move_base_msgs::MoveBaseGoal>())
        mayRefuse([&] {
          nodes::checkGoal(goal->target_pose, nodes::ZeroHeading::REFUSED);
          navigator.drop();
          ends = 0;
          navigator.start(now);
        });
      return;
    default:
      return navigator.tick(now);
  }
}

FUZZ_TARGET(go_to_pose_messages, seedsOfGoals) {
  Messages messages(input);
  Navigator navigator;
  double now = 1000.0;
  int ends = 0;
  for (int i = 0; i < kMostHeard && !messages.atEnd(); ++i, now += 0.6) {
    hear(messages, navigator, now, ends);
    for (const NavigatorOrder& order : navigator.takeOrders()) {
      for (const path::Pose& pose : order.path.poses)
        mustHold(pose.position.allFinite() && std::isfinite(pose.yaw), "what is driven is finite");
      ends += order.kind == NavigatorOrder::Kind::SUCCEED ||
              order.kind == NavigatorOrder::Kind::ABORT ||
              order.kind == NavigatorOrder::Kind::PREEMPT;
    }
    mustHold(ends <= 1, "a goal ends once");
  }
}

std::vector<std::string> seedsOfStatuses() {
  actionlib_msgs::GoalStatusArray array;
  for (const char* id : {"/go-calls-1-1", "/go-calls-0-7", "/other", "/go-calls-1-2"}) {
    array.status_list.emplace_back();
    array.status_list.back().goal_id.id = id;
    array.status_list.back().status = actionlib_msgs::GoalStatus::ACTIVE;
  }
  return {bytesOf(array), bytesOf(actionlib_msgs::GoalStatusArray())};
}

FUZZ_TARGET(goal_statuses, seedsOfStatuses) {
  const auto status = messageOf<actionlib_msgs::GoalStatusArray>(input);
  if (!status) return;
  const nodes::GoalNames names{"/go-calls-", "/go-calls-1-1"};
  const nodes::GoalsOfStatus seen = nodes::seenGoals(*status, names);
  for (const std::string& id : seen.earlier)
    mustHold(id.rfind(names.mine, 0) == 0 && id != names.id,
             "only its own goals are cancelled, and not the one that goes on");
  mustHold(!nodes::seenGoals(*status, {names.mine, ""}).own, "without a goal none is seen");
}

std::vector<std::string> seedsOfStamps() {
  actionlib_msgs::GoalID id;
  id.stamp = ros::Time(4294967295u, 999999999u);
  const std::string now = bytesOf(std_msgs::Header());
  return {now + "\x01" + bytesOf(id) + now + std::string(1, '\0') + bytesOf(id),
          bytesOf([] {
            std_msgs::Header end;
            end.stamp = ros::Time(4294967295u, 999999999u);
            return end;
          }()) +
              std::string(1, '\0') + bytesOf(id) + now + std::string(1, '\0') + bytesOf(id)};
}

// Goals and cancels at any time of /clock, with any stamps of their own.
FUZZ_TARGET(goal_stamps, seedsOfStamps) {
  Messages messages(input);
  nodes::ActionStamps stamps;
  ros::Time newest, before;
  for (int i = 0; i < kMostHeard && !messages.atEnd(); ++i) {
    const auto clock = messages.next<std_msgs::Header>();
    const bool is_cancel = messages.byte() % 2 == 1;
    const auto id = messages.next<actionlib_msgs::GoalID>();
    if (!clock || !id) return;
    const ros::Time now(clock->stamp.sec, clock->stamp.nsec % 1000000000);
    if (now < std::exchange(before, now)) stamps.timeWentBack();  // as NodeTime tells it
    const ros::Time given =
        is_cancel ? stamps.ofCancel(id->stamp, now) : stamps.ofGoal(id->stamp, now);
    const bool is_overtaken = !is_cancel && given == ros::TIME_MIN;  // by a cancel
    mustHold(is_cancel || is_overtaken || given >= newest, "a later goal has a later stamp");
    mustHold(!is_cancel || given <= stamps.ofGoal({}, now), "no cancel is of goals to come");
    newest = is_cancel || is_overtaken ? newest : given;
  }
}

}  // namespace
}  // namespace grid_path_planner::fuzz
