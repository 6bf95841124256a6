// A cancel that its server never had: the client was told that the goal was cancelled, and the vehicle drove on to its end.
#include "ros/guard/action/action_caller.h"

#include <actionlib_msgs/GoalStatusArray.h>
#include <gtest/gtest.h>
#include <ros/callback_queue.h>

#include "grid_path_planner/NavigatePathAction.h"
#include "ros/support/latest.h"
#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

using actionlib_msgs::GoalStatus;
using Caller = ActionCaller<NavigatePathAction>;

class ActionCallerTest : public testing::Test {
 protected:
  ActionCallerTest() {
    EXPECT_TRUE(
        test::waitFor([&] { return caller_.isThere() && status_.getNumSubscribers() > 0; }));
    caller_.send({});
    EXPECT_TRUE(goals_.waitForMoreThan(0));
  }
  // Whose callbacks are this thread's.
  static ros::NodeHandle served(ros::CallbackQueue& queue) {
    ros::NodeHandle nh;
    nh.setCallbackQueue(&queue);
    return nh;
  }
  std::string sent() const { return goals_.all().back().goal_id.id; }
  void say(std::uint8_t status, const std::string& id) {
    actionlib_msgs::GoalStatusArray array;
    array.status_list.resize(1);
    array.status_list.back().goal_id.id = id;
    array.status_list.back().status = status;
    status_.publish(array);
    queue_.callAvailable();
  }
  // Whether so many cancels of that goal come while its server says this.
  bool cancels(std::size_t number, std::uint8_t status, const std::string& id) {
    return test::waitFor([&] {
      say(status, id);
      return cancels_.count() >= number && cancels_.all().back().id == id;
    });
  }

  ros::NodeHandle nh_;
  test::Latest<NavigatePathActionGoal> goals_{nh_, "navigate_path/goal"};
  test::Latest<actionlib_msgs::GoalID> cancels_{nh_, "navigate_path/cancel"};
  ros::Publisher results_ = nh_.advertise<NavigatePathActionResult>("navigate_path/result", 1);
  ros::Publisher feedback_ = nh_.advertise<NavigatePathActionFeedback>("navigate_path/feedback", 1);
  ros::Publisher status_ =
      nh_.advertise<actionlib_msgs::GoalStatusArray>("navigate_path/status", 1);
  ros::CallbackQueue queue_;
  Caller caller_{served(queue_),
                 "/go",
                 "navigate_path",
                 {[](const NavigatePathResult&) {}, [](const NavigatePathFeedback&) {},
                  [](const std::string&) {}}};
};

TEST_F(ActionCallerTest, RepeatsACancelWhileTheGoalGoesOn) {
  caller_.cancel();
  EXPECT_TRUE(cancels(3, GoalStatus::ACTIVE, sent()));
}

TEST_F(ActionCallerTest, CancelsAGoalThatItHasForgottenAndNotTheOneThatGoesOn) {
  const std::string before = sent();
  caller_.send({});
  ASSERT_TRUE(goals_.waitForMoreThan(1));
  EXPECT_TRUE(cancels(1, GoalStatus::ACTIVE, before));
  EXPECT_NE(sent(), before);
  for (int i = 0; i < 20; ++i) {
    say(GoalStatus::ACTIVE, sent());
    ros::WallDuration(0.01).sleep();
  }
  for (const auto& cancel : cancels_.all()) EXPECT_EQ(cancel.id, before);
}

}  // namespace
}  // namespace grid_path_planner::nodes
