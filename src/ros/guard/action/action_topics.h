// The topics of an action server, with the stamps of ActionStamps instead of the senders'.
//
// A header that everything includes which has such a server declares a specialization of
// actionlib::ActionServer<FooAction>::initialize(); one source defines it by openActionTopics(), which
// takes the server's own members (plan_action.cpp).
//
// A member of the library's class is specialized because SimpleActionServer makes its ActionServer
// itself. What it replaces does the same but for the stamps, for goals whose lengths lie
// (claimed_lengths.h), for goals that wait, which are bounded in bytes too (bounded_subscription.h), for the clock of its
// status, and for parameters that nobody sets.
#pragma once

#include <actionlib/server/action_server.h>
#include <actionlib_msgs/GoalStatus.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <list>
#include <memory>

#include "ros/guard/action/action_stamps.h"
#include "ros/guard/incoming/bounded_subscription.h"
#include "ros/guard/node_time.h"
#include "ros/guard/scheduling/guarded_timer.h"

namespace grid_path_planner::nodes {

constexpr double kActionStatusPeriod = 0.2;  // s, wall time
constexpr double kActionStatusTimeout =
    5.0;  // s; how long the status of an ended goal is published
constexpr std::uint32_t kActionQueueSize = 50;  // messages

template <class Action>
struct ActionTopics {
  ros::Subscriber& goals;
  ros::Subscriber& cancels;
  ros::Publisher& results;
  ros::Publisher& feedback;
  ros::Publisher& status;
  ros::Timer& status_timer;
  ros::Duration& status_timeout;
  std::list<actionlib::StatusTracker<Action>>& statuses;
  boost::recursive_mutex& lock;  // of the statuses
};

// actionlib adds the timeout to the time at which a goal ended, and roscpp throws where that is beyond what a time can
// hold: in the thread of a server that executes, this ends the process.
inline ros::Time lastTimeOfActions() {
  return ros::TIME_MAX - ros::Duration(2.0 * kActionStatusTimeout);
}

// For goals that ended while /clock was beyond that: no status would be published any more, and no goal be taken.
template <class Statuses>
void boundEnds(Statuses& statuses, boost::recursive_mutex& lock) {
  const boost::recursive_mutex::scoped_lock locked(lock);
  for (auto& status : statuses)
    status.handle_destruction_time_ =
        std::min(status.handle_destruction_time_, lastTimeOfActions());
}

// The answer to a goal that comes meanwhile.
template <class Action>
typename Action::_action_result_type rejection(const actionlib_msgs::GoalID& goal) {
  typename Action::_action_result_type result;
  result.header.stamp = ros::Time::now();
  result.status.goal_id = goal;
  result.status.status = actionlib_msgs::GoalStatus::REJECTED;
  result.status.text = "ROS time is at the end of what it can say";
  return result;
}

// `node` is the action's own namespace.
template <class Action>
void openActionTopics(actionlib::ActionServerBase<Action>& server, ros::NodeHandle& node,
                      const ActionTopics<Action>& topics,
                      const ros::TimerCallback& publish_status) {
  using Goal = typename Action::_action_goal_type;
  using Cancel = actionlib_msgs::GoalID;
  topics.results = node.advertise<typename Action::_action_result_type>("result", kActionQueueSize);
  topics.feedback =
      node.advertise<typename Action::_action_feedback_type>("feedback", kActionQueueSize);
  topics.status = node.advertise<actionlib_msgs::GoalStatusArray>("status", kActionQueueSize, true);
  const auto stamps = std::make_shared<ActionStamps>();
  const auto on_jump_back =
      NodeTime::of(node).onJumpBack([stamps](double) { stamps->timeWentBack(); });
  using GoalPtr = boost::shared_ptr<const Goal>;
  const auto bound_ends = [&statuses = topics.statuses, &lock = topics.lock] {
    boundEnds(statuses, lock);
  };
  const auto on_goal = [&server, stamps, on_jump_back, bound_ends,
                        &results = topics.results](const GoalPtr& message) {
    bound_ends();
    if (lastTimeOfActions() < ros::Time::now())
      return results.publish(rejection<Action>(message->goal_id));
    const auto goal = boost::make_shared<Goal>(*message);
    goal->goal_id.stamp = stamps->ofGoal(message->goal_id.stamp, ros::Time::now());
    server.goalCallback(goal);
  };
  const boost::function<void(const boost::shared_ptr<const Cancel>&)> on_cancel =
      [&server, stamps](const boost::shared_ptr<const Cancel>& message) {
        const auto cancel = boost::make_shared<Cancel>(*message);
        cancel->stamp = stamps->ofCancel(message->stamp, ros::Time::now());
        server.cancelCallback(cancel);
      };
  const WaitingBound most{kActionQueueSize, kMostWaitingBytes};
  topics.goals = subscribeBounded<Goal, const GoalPtr&>(node, "goal", most, on_goal);
  topics.cancels = subscribeBounded<Cancel, const boost::shared_ptr<const Cancel>&>(
      node, "cancel", most, on_cancel);
  topics.status_timeout = ros::Duration(kActionStatusTimeout);
  // roscpp's timers of ROS time end the process where /clock says 4294967295.9 s. The server's own never starts; it holds
  // this one, which ends with it, before all that is published to.
  const auto timer = boost::make_shared<ros::SteadyTimer>(
      guardedTimer(node, kActionStatusPeriod, [publish_status, bound_ends] {
        bound_ends();
        publish_status(ros::TimerEvent());
      }));
  topics.status_timer = node.createTimer(
      ros::Duration(kActionStatusPeriod), [timer](const ros::TimerEvent&) {}, false, false);
}

}  // namespace grid_path_planner::nodes
