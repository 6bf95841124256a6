// A whole vehicle in one manager: planner and driver hear the same tf, of a simulator beside them. Seen before, by reading: the
// one that was loaded second had none, so that it never planned or never drove.
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <cmath>

#include "ros/support/manager_client.h"
#include "ros/support/planner_fixture.h"
#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

TEST(NodeletVehicle, PlansFromTfAndDrives) {
  ros::NodeHandle nh;
  const geometry_msgs::PoseStamped goal = test::poseAt(-0.2, -0.2);
  double left = 1e9;  // m
  const ros::Subscriber odometry =
      nh.subscribe<nav_msgs::Odometry>("odom", 1, [&](const nav_msgs::Odometry::ConstPtr& odom) {
        const auto &at = odom->pose.pose.position, &to = goal.pose.position;
        left = std::hypot(at.x - to.x, at.y - to.y);
      });
  ros::Publisher goals = nh.advertise<geometry_msgs::PoseStamped>("goal", 1);
  test::ManagerClient manager("/manager");
  ASSERT_TRUE(test::waitFor([&] { return manager.loaded().size() == 4; }));
  ASSERT_TRUE(test::waitFor([&] { return goals.getNumSubscribers() > 0; }));
  ros::SteadyTime asked;
  EXPECT_TRUE(test::waitFor([&] {  // again until map and tf have come
    const ros::SteadyTime now = ros::SteadyTime::now();
    if (left > 1.0 && now - asked > ros::WallDuration(1.0)) {
      goals.publish(goal);
      asked = now;
    }
    ros::spinOnce();
    return left < 0.15;
  })) << left;
}

}  // namespace
}  // namespace grid_path_planner::nodes
