// Goals of an action by its topics, without waiting: what an action client is made of.
//
//   ActionLink<PlanPathAction> link(nh, "plan_path");
//   link.onFeedback = [](const std::string&, const PlanPathFeedback& feedback) { use(feedback); };
//   link.onResult = [](const PlanPathActionResult& message) { use(message.result); };
//   const std::string id = link.send(goal);
//   link.cancel(id);
//
// actionlib's client holds a goal as active for ever when its server is gone; here the caller judges,
// by servers() and by what it hears. Feedback and results of other clients' goals are given too; messages
// whose lengths lie are dropped. Callbacks come in the queue of `nh`.
#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/node_handle.h>
#include <ros/this_node.h>

#include <algorithm>
#include <functional>
#include <string>

#include "ros/guard/incoming/claimed_lengths.h"

namespace grid_path_planner::nodes {

template <class Action>
class ActionLink {
 public:
  using ActionGoal = typename Action::_action_goal_type;
  using ActionFeedback = typename Action::_action_feedback_type;
  using ActionResult = typename Action::_action_result_type;
  using Goal = typename ActionGoal::_goal_type;
  using Feedback = typename ActionFeedback::_feedback_type;

  ActionLink(ros::NodeHandle nh, const std::string& name)
      : goals_(nh.advertise<ActionGoal>(name + "/goal", 10)),
        cancels_(nh.advertise<actionlib_msgs::GoalID>(name + "/cancel", 10)),
        states_(subscribeChecked<actionlib_msgs::GoalStatusArray>(nh, name + "/status", 1,
                                                                  &ActionLink::passOver)),
        feedback_(subscribeChecked<ActionFeedback>(nh, name + "/feedback", 10,
                                                   [this](const ActionFeedback& message) {
                                                     if (onFeedback)
                                                       onFeedback(message.status.goal_id.id,
                                                                  message.feedback);
                                                   })),
        results_(subscribeChecked<ActionResult>(nh, name + "/result", 10,
                                                [this](const ActionResult& message) {
                                                  if (onResult) onResult(message);
                                                })) {}
  ActionLink(const ActionLink&) = delete;
  ActionLink& operator=(const ActionLink&) = delete;

  // How many nodes offer the action. One that was killed no longer listens; who only listens, such
  // as a recording, has no status.
  std::size_t servers() const {
    return std::min(goals_.getNumSubscribers(), states_.getNumPublishers());
  }

  std::string send(const Goal& goal) {
    ActionGoal message;
    message.header.stamp = ros::Time::now();
    message.goal_id.stamp = message.header.stamp;
    message.goal_id.id =
        ros::this_node::getName() + "-panel-" + std::to_string(ros::WallTime::now().toNSec());
    message.goal = goal;
    goals_.publish(message);
    return message.goal_id.id;
  }

  void cancel(const std::string& id) {
    actionlib_msgs::GoalID message;
    message.id = id;
    cancels_.publish(message);
  }

  std::function<void(const std::string& id, const Feedback&)> onFeedback;
  std::function<void(const ActionResult&)> onResult;

 private:
  // Who publishes the status is all that is asked.
  static void passOver(const actionlib_msgs::GoalStatusArray&) {}

  ros::Publisher goals_, cancels_;
  ros::Subscriber states_, feedback_, results_;
};

}  // namespace grid_path_planner::nodes
