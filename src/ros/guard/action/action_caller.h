// A client of another node's action: one goal at a time, and told when the server is gone.
//
//   ActionCaller<PlanPathAction> planner(nh, "/go_to_pose", "plan_path", {on_result, on_feedback, on_lost});
//   planner.send(goal);                               // instead of the one before
//   planner.watch(timeout);                           // a few times a second
//
// Of actionlib's clients it differs where the network is hostile or the other node dies: lengths that lie are refused
// before they are unpacked (claimed_lengths.h), a server that was restarted, hangs or is gone is told within `timeout`
// seconds of the wall clock, and goals that an earlier process of this node's name left behind are cancelled; a cancel that
// was lost is repeated with each status that says that its goal goes on.
//
// Guaranteed: every goal that is sent ends by exactly one call of on_result or on_lost, unless forget() or another send()
// comes first. All calls come from the queue of `nh`, or from watch().
#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "base/seconds_since.h"
#include "ros/guard/action/goals_of_status.h"
#include "ros/guard/incoming/bounded_subscription.h"

namespace grid_path_planner::nodes {

template <class Action>
class ActionCaller {
 public:
  using Goal = typename Action::_action_goal_type::_goal_type;
  using Result = typename Action::_action_result_type::_result_type;
  using Feedback = typename Action::_action_feedback_type::_feedback_type;

  struct Handlers {
    std::function<void(const Result&)> on_result;
    std::function<void(const Feedback&)> on_feedback;
    std::function<void(const std::string& sentence)> on_lost;
  };

  // `owner`: the resolved name of the node or nodelet, by which its goals are known after a restart.
  ActionCaller(ros::NodeHandle nh, const std::string& owner, const std::string& name,
               Handlers handlers)
      : name_(nh.resolveName(name)), handlers_(std::move(handlers)), mine_(owner + "-calls-") {
    using ActionResult = typename Action::_action_result_type;
    using ActionFeedback = typename Action::_action_feedback_type;
    goals_ = nh.advertise<typename Action::_action_goal_type>(name + "/goal", 10);
    cancels_ = nh.advertise<actionlib_msgs::GoalID>(name + "/cancel", 10);
    const WaitingBound most{10, kMostWaitingBytes};
    results_ = subscribeBounded<ActionResult>(
        nh, name + "/result", most, [this](const ActionResult& result) { onResult(result); });
    feedback_ = subscribeBounded<ActionFeedback>(
        nh, name + "/feedback", most,
        [this](const ActionFeedback& feedback) { onFeedback(feedback); });
    status_ = subscribeBounded<actionlib_msgs::GoalStatusArray>(
        nh, name + "/status", most,
        [this](const actionlib_msgs::GoalStatusArray& status) { onStatus(status); });
  }

  // The resolved name.
  const std::string& name() const { return name_; }

  // Whether a server hears goals and is heard.
  bool isThere() const {
    return goals_.getNumSubscribers() > 0 && cancels_.getNumSubscribers() > 0 &&
           results_.getNumPublishers() > 0 && feedback_.getNumPublishers() > 0;
  }
  bool active() const { return !id_.empty(); }

  // It goes out once a server is there. At most once, since a server does a goal that comes twice once.
  void send(const Goal& goal) {
    typename Action::_action_goal_type message;
    message.goal = goal;
    std::string id = life_ + std::to_string(++count_);
    message.goal_id.id = id;
    forget();  // by now nothing wants memory any more
    id_ = std::move(id);
    waiting_ = std::move(message);
    heard_ = Clock::now();
    sendWaiting();
  }
  // The server is asked to end the goal, and its result awaited.
  void cancel() {
    if (waiting_) return lose("the goal was not sent yet");
    if (!active()) return;
    cancelled_ = true;
    cancelNamed(id_);
  }
  void forget() {
    waiting_.reset();
    id_.clear();
    acknowledged_ = cancelled_ = false;
    ended_.reset();
  }

  void watch(double timeout) {
    sendWaiting();
    if (!active()) return;
    const bool silent = base::secondsSince(heard_) > timeout;
    if (waiting_ && silent)
      lose("nobody serves it");
    else if (!waiting_ && !isThere())
      lose("its server is gone");
    else if (ended_ && base::secondsSince(*ended_) > kResultDelay)
      lose("it ended without a result");
    else if (silent)
      lose("nothing has been heard of its server");
  }

 private:
  using Clock = std::chrono::steady_clock;

  static constexpr double kResultDelay = 2.0;  // s, by which a result may come after the status

  void sendWaiting() {
    if (!waiting_ || !isThere() || !ros::Time::isValid()) return;
    waiting_->header.stamp = waiting_->goal_id.stamp = ros::Time::now();
    goals_.publish(*waiting_);
    waiting_.reset();
    heard_ = Clock::now();
  }
  void cancelNamed(const std::string& id) {
    actionlib_msgs::GoalID message;  // no stamp: this goal alone
    message.id = id;
    cancels_.publish(message);
  }
  // A server that hangs does not take the goal up again later.
  void lose(const std::string& why) {
    if (!waiting_) cancelNamed(id_);
    forget();
    handlers_.on_lost("the action " + name_ + ": " + why);
  }

  void onResult(const typename Action::_action_result_type& message) {
    if (!active() || message.status.goal_id.id != id_) return;
    forget();
    handlers_.on_result(message.result);
  }
  void onFeedback(const typename Action::_action_feedback_type& message) {
    if (!active() || message.status.goal_id.id != id_) return;
    heard_ = Clock::now();
    handlers_.on_feedback(message.feedback);
  }
  void onStatus(const actionlib_msgs::GoalStatusArray& message) {
    const GoalsOfStatus seen = seenGoals(message, {mine_, id_});
    for (const std::string& id : seen.earlier) cancelNamed(id);
    if (cancelled_ && seen.own && !seen.own_is_over) cancelNamed(id_);
    if (seen.own_is_over && !ended_) ended_ = Clock::now();
    if (!active() || waiting_) return;
    if (seen.own) {
      acknowledged_ = true;
      heard_ = Clock::now();
    } else if (acknowledged_) {
      lose("its server was started anew");
    }
  }

  const std::string name_;
  const Handlers handlers_;
  const std::string mine_;
  const std::string life_ = mine_ + std::to_string(ros::WallTime::now().toNSec()) + "-";
  ros::Publisher goals_, cancels_;
  ros::Subscriber results_, feedback_, status_;
  unsigned count_ = 0;
  std::string id_;  // of the goal that goes on; "" without one
  std::optional<typename Action::_action_goal_type> waiting_;  // not sent yet
  bool acknowledged_ = false;
  bool cancelled_ = false;
  std::optional<Clock::time_point> ended_;  // by its status
  Clock::time_point heard_;
};

}  // namespace grid_path_planner::nodes
