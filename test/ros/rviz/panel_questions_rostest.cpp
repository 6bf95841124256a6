// What the panel asks of path_planner's services, which here answer when the test says so.
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <atomic>
#include <boost/function.hpp>

#include "grid_path_planner/ExplainPlan.h"
#include "grid_path_planner/PlanPathAction.h"
#include "ros/rviz/action_topics.h"
#include "ros/rviz/panel_window.h"
#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

class PanelQuestions : public testing::Test {
 protected:
  void setGoal(double x) {
    ASSERT_TRUE(window_.waitFor([&] { return points_.getNumSubscribers() > 0; }));
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = "map";
    pose.pose.position.x = x;
    pose.pose.orientation.w = 1.0;
    points_.publish(pose);
  }

  std::atomic<bool> may_answer_{false};
  ros::NodeHandle nh_;
  test::ActionServerTopics<PlanPathAction> planner_{"plan_path"};
  ros::Publisher points_ = nh_.advertise<geometry_msgs::PoseStamped>("plan_panel/goal", 1);
  test::PanelWindow window_;
};

// It was drawn and told beside the points that had been set meanwhile, in their frame.
TEST_F(PanelQuestions, AnExplanationOfOtherPointsIsNotShown) {
  const boost::function<bool(ExplainPlan::Request&, ExplainPlan::Response&)> explain =
      [this](ExplainPlan::Request&, ExplainPlan::Response& response) {
        response.status = "UNREACHABLE";
        response.message = "of the goal before";
        return test::waitFor([this] { return may_answer_.load(); });
      };
  const ros::ServiceServer service = nh_.advertiseService("path_planner/explain_plan", explain);
  setGoal(1.0);
  ASSERT_TRUE(window_.click("Explain"));
  ASSERT_TRUE(window_.waitFor([&] { return window_.shows("Explaining"); }));
  setGoal(2.0);
  ASSERT_TRUE(window_.waitFor([&] { return window_.shows("Press Plan, Compare or Explain"); }));
  may_answer_ = true;
  EXPECT_TRUE(window_.waitFor([&] {
    return window_.shows("The points are others by now") || window_.shows("of the goal before");
  }));
  EXPECT_FALSE(window_.shows("of the goal before"));
}

}  // namespace
}  // namespace grid_path_planner::nodes
