// The topics of an action's server, without a server: what the panel sends is seen, and what it hears is made up.
//
//   ActionServerTopics<NavigatePathAction> driver("navigate_path");
//   ASSERT_TRUE(window.waitFor([&] { return driver.goals.count() > 0; }));
//   driver.end(driver.goals.all()[0].goal_id, result);
#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "ros/support/latest.h"

namespace grid_path_planner::test {

template <class Action>
struct ActionServerTopics {
  using Goal = typename Action::_action_goal_type;
  using Feedback = typename Action::_action_feedback_type;
  using Result = typename Action::_action_result_type;

  explicit ActionServerTopics(const std::string& name)
      : goals(nh, name + "/goal"),
        cancels(nh, name + "/cancel"),
        status(nh.advertise<actionlib_msgs::GoalStatusArray>(name + "/status", 1)),
        feedback(nh.advertise<Feedback>(name + "/feedback", 10)),
        results(nh.advertise<Result>(name + "/result", 10)) {}

  void tell(const actionlib_msgs::GoalID& goal,
            const typename Feedback::_feedback_type& what) const {
    Feedback message;
    message.status.goal_id = goal;
    message.feedback = what;
    feedback.publish(message);
  }
  void end(const actionlib_msgs::GoalID& goal, const typename Result::_result_type& how) const {
    Result message;
    message.status.goal_id = goal;
    message.result = how;
    results.publish(message);
  }

  ros::NodeHandle nh;
  Latest<Goal> goals;
  Latest<actionlib_msgs::GoalID> cancels;
  ros::Publisher status, feedback, results;
};

}  // namespace grid_path_planner::test
