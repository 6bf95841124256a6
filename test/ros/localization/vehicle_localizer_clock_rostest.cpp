// A bag that is played again: ROS time goes back, and everything begins anew.
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "ros/support/sensor_stream.h"

namespace grid_path_planner::nodes {
namespace {

TEST(VehicleLocalizerClock, ABagThatLoopsIsAFreshStart) {
  ros::NodeHandle nh;
  test::SensorStream stream(nh);
  ros::Publisher clock = nh.advertise<rosgraph_msgs::Clock>("/clock", 10);
  test::Latest<nav_msgs::Odometry> filtered(nh, "odometry/filtered");
  test::Process node("vehicle_localizer", {});
  // From second 100 on, until `done`.
  const auto play = [&](const std::function<bool()>& done) {
    int tick = 0;
    return test::waitFor([&] {
      rosgraph_msgs::Clock now;
      now.clock = ros::Time(100) + ros::Duration(0.01 * ++tick);
      clock.publish(now);
      stream.send(now.clock, tick);
      return done();
    });
  };
  const auto errorOfNewest = [&] {
    const nav_msgs::Odometry newest = filtered.all().back();
    const double t = (newest.header.stamp - ros::Time(100)).toSec();
    const auto& p = newest.pose.pose.position;
    return (stream.positionAt(t) - Eigen::Vector3d(p.x, p.y, p.z)).norm();
  };
  ASSERT_TRUE(play([&] { return filtered.count() > 100; }));
  EXPECT_LT(errorOfNewest(), 0.2);
  const ros::Time end = filtered.all().back().header.stamp;
  const std::size_t before = filtered.count();
  // The second time the vehicle is elsewhere: nothing of the first may be left.
  stream.trajectory.shift = {500.0, -300.0, -10.0};
  ASSERT_TRUE(play([&] { return filtered.count() > before + 100; }));
  EXPECT_TRUE(node.says("ROS time went back"));
  EXPECT_LT(filtered.all()[before + 20].header.stamp, end);
  EXPECT_LT(errorOfNewest(), 0.2);
}

}  // namespace
}  // namespace grid_path_planner::nodes
