// The server of the action that move_base offers, with the stamps of action_topics.h.
#pragma once

#include <actionlib/server/action_server.h>
#include <move_base_msgs/MoveBaseAction.h>

#include "ros/guard/action/action_topics.h"

namespace actionlib {

template <>
inline void ActionServer<move_base_msgs::MoveBaseAction>::initialize() {
  grid_path_planner::nodes::openActionTopics(
      *this, node_,
      {goal_sub_, cancel_sub_, result_pub_, feedback_pub_, status_pub_, status_timer_,
       status_list_timeout_, status_list_, lock_},
      [this](const ros::TimerEvent&) { publishStatus(); });
}

}  // namespace actionlib

namespace grid_path_planner::nodes {

// Not a SimpleActionServer: that one cannot refuse a goal without giving up the one before.
using MoveBaseServer = actionlib::ActionServer<move_base_msgs::MoveBaseAction>;
using MoveBaseGoal = MoveBaseServer::GoalHandle;

}  // namespace grid_path_planner::nodes
