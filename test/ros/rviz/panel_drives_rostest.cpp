// What the panel asks of navigate_path, whose topics are the test's own; it has no services.
#include <actionlib_msgs/GoalID.h>
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <string>

#include "grid_path_planner/NavigatePathAction.h"
#include "grid_path_planner/PlanPathAction.h"
#include "ros/rviz/action_topics.h"
#include "ros/rviz/panel_window.h"

namespace grid_path_planner::nodes {
namespace {

using actionlib_msgs::GoalID;
using test::ActionServerTopics;
using test::PanelWindow;

geometry_msgs::PoseStamped poseAt(double x) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "map";
  pose.pose.position.x = x;
  pose.pose.orientation.w = 1.0;
  return pose;
}

PlanPathResult foundPath() {
  PlanPathResult result;
  result.status = "FOUND";
  result.message = "a path of two poses";
  result.path.header.frame_id = "map";
  result.path.poses = {poseAt(0.0), poseAt(1.0)};
  return result;
}

class PanelDrives : public testing::Test {
 protected:
  // Plans to a point and drives there; the goal's id.
  GoalID drive() {
    ros::Publisher points = driver_.nh.advertise<geometry_msgs::PoseStamped>("plan_panel/goal", 1);
    EXPECT_TRUE(window_.waitFor([&] { return points.getNumSubscribers() > 0; }));
    points.publish(poseAt(1.0));
    EXPECT_TRUE(window_.click("Plan"));
    EXPECT_TRUE(window_.waitFor([&] { return planner_.goals.count() > 0; }));
    if (planner_.goals.count() == 0) return {};
    planner_.end(planner_.goals.all().back().goal_id, foundPath());
    EXPECT_TRUE(window_.click("Drive"));
    EXPECT_TRUE(window_.waitFor([&] { return driver_.goals.count() > 0; }));
    return driver_.goals.count() > 0 ? driver_.goals.all().back().goal_id : GoalID();
  }

  ActionServerTopics<PlanPathAction> planner_{"plan_path"};
  ActionServerTopics<NavigatePathAction> driver_{"navigate_path"};
  PanelWindow window_;
};

// Cancel called a service alone, which is looked up at the master: without one the vehicle drove on.
TEST_F(PanelDrives, ADriveIsCancelledByItsTopicWhereThereIsNoService) {
  const GoalID goal = drive();
  ASSERT_FALSE(goal.id.empty());
  ASSERT_TRUE(window_.click("Cancel"));
  ASSERT_TRUE(window_.waitFor([&] { return driver_.cancels.count() > 0; }));
  EXPECT_EQ(driver_.cancels.all()[0].id, goal.id);
}

TEST_F(PanelDrives, ADriveOfSomebodyElseIsCancelledByItsTopicToo) {
  ASSERT_TRUE(window_.click("Cancel"));
  ASSERT_TRUE(window_.waitFor([&] { return driver_.cancels.count() > 0; }));
  const GoalID all = driver_.cancels.all()[0];
  EXPECT_EQ(all.id, "");
  EXPECT_TRUE(all.stamp.isZero()) << "of whenever";
}

}  // namespace
}  // namespace grid_path_planner::nodes
