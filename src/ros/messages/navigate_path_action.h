// The server of the action `navigate_path`, with the stamps of action_topics.h, for whoever drives or flies.
#pragma once

#include <actionlib/server/simple_action_server.h>

#include "grid_path_planner/NavigatePathAction.h"
#include "ros/guard/action/action_topics.h"

namespace actionlib {

template <>
inline void ActionServer<grid_path_planner::NavigatePathAction>::initialize() {
  grid_path_planner::nodes::openActionTopics(
      *this, node_,
      {goal_sub_, cancel_sub_, result_pub_, feedback_pub_, status_pub_, status_timer_,
       status_list_timeout_, status_list_, lock_},
      [this](const ros::TimerEvent&) { publishStatus(); });
}

}  // namespace actionlib

namespace grid_path_planner::nodes {

using NavigatePathServer = actionlib::SimpleActionServer<NavigatePathAction>;

}  // namespace grid_path_planner::nodes
