// What the status of an action says of a client's goals.
//
//   const GoalsOfStatus seen = seenGoals(status, {"/go_to_pose-calls-", id});
//   if (seen.own_is_over) waitForResult();
#pragma once

#include <actionlib_msgs/GoalStatus.h>
#include <actionlib_msgs/GoalStatusArray.h>

#include <string>
#include <vector>

namespace grid_path_planner::nodes {

// By which a client knows its goals.
struct GoalNames {
  std::string mine;  // what the names of all begin with, also of those that an earlier process sent
  std::string id;    // the one that goes on; "" without one
};

struct GoalsOfStatus {
  bool own = false;  // the status has the goal that goes on
  bool own_is_over = false;
  std::vector<std::string>
      earlier;  // others of its own, also of earlier processes, that go on still
};

inline bool isGoalOver(const actionlib_msgs::GoalStatus& status) {
  using actionlib_msgs::GoalStatus;
  return status.status != GoalStatus::PENDING && status.status != GoalStatus::ACTIVE &&
         status.status != GoalStatus::PREEMPTING && status.status != GoalStatus::RECALLING;
}

inline GoalsOfStatus seenGoals(const actionlib_msgs::GoalStatusArray& message,
                               const GoalNames& names) {
  const auto beginsWith = [](const std::string& text, const std::string& beginning) {
    return text.compare(0, beginning.size(), beginning) == 0;
  };
  GoalsOfStatus seen;
  for (const actionlib_msgs::GoalStatus& status : message.status_list) {
    const std::string& id = status.goal_id.id;
    if (!names.id.empty() && id == names.id) {
      seen.own = true;
      seen.own_is_over = seen.own_is_over || isGoalOver(status);
    } else if (!isGoalOver(status) && beginsWith(id, names.mine)) {
      seen.earlier.push_back(id);
    }
  }
  return seen;
}

}  // namespace grid_path_planner::nodes
