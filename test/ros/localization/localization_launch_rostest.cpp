// A vehicle that knows where it is by its sensors and a camera only: localization.launch before the simulated panel.
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/String.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "ros/support/latest.h"
#include "support/error_text.h"

namespace grid_path_planner::nodes {
namespace {

using Eigen::Vector3d;
using nav_msgs::Odometry;
using test::Latest;
using test::waitFor;

constexpr double kAllowed = 0.1;  // m
constexpr double kSeconds = 6.0;  // of simulated time

Vector3d positionOf(const Odometry& odometry) {
  const auto& p = odometry.pose.pose.position;
  return {p.x, p.y, p.z};
}

double yawOf(const Odometry& odometry) {
  const auto& q = odometry.pose.pose.orientation;
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

// Towards the goal, slower the nearer it is, with the yaw that is wanted.
geometry_msgs::Twist commandTo(const Vector3d& goal, double yaw, const Odometry& estimate) {
  const double heading = yawOf(estimate);
  Vector3d velocity = goal - positionOf(estimate);
  velocity *= 0.3 / std::max(0.3, velocity.norm());
  const Vector3d own = Eigen::AngleAxisd(-heading, Vector3d::UnitZ()) * velocity;
  geometry_msgs::Twist command;
  command.linear.x = own.x();
  command.linear.y = own.y();
  command.linear.z = own.z();
  command.angular.z = std::remainder(yaw - heading, 2.0 * M_PI);
  return command;
}

// Half a metre aside and back towards the panel's middle, on nothing but the estimate: the truth is only looked at.
TEST(LocalizationLaunch, AVehicleDrivesOnTheEstimateByMarkersAndStaysNearTheTruth) {
  ros::NodeHandle nh;
  Latest<std_msgs::String> status(nh, "localization_status");
  Latest<geometry_msgs::PoseWithCovarianceStamped> fixes(nh, "marker_pose");
  Latest<Odometry> estimates(nh, "odometry/filtered"), truths(nh, "ground_truth");
  ros::Publisher commands = nh.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  ASSERT_TRUE(waitFor([&] {
    const auto all = status.all();
    return !all.empty() && test::contains(all.back().data, "OK:") && estimates.count() > 0;
  }));
  const Odometry begin = estimates.all().back();
  const Vector3d goal = positionOf(begin) + Vector3d(0.4, 0.2, 0.1);
  ASSERT_TRUE(waitFor([&] {
    const Odometry estimate = estimates.all().back();
    commands.publish(commandTo(goal, 1.99, estimate));
    ros::WallDuration(0.05).sleep();
    return (estimate.header.stamp - begin.header.stamp).toSec() > kSeconds;
  }));
  EXPECT_GT(fixes.count(), 5u);
  const std::vector<Odometry> all = estimates.all(), real = truths.all();
  std::size_t compared = 0;
  for (const Odometry& estimate : all) {
    if (estimate.header.stamp < begin.header.stamp) continue;
    const auto truth = std::find_if(real.begin(), real.end(), [&](const Odometry& o) {
      return o.header.stamp == estimate.header.stamp;
    });
    if (truth == real.end()) continue;
    ++compared;
    EXPECT_LT((positionOf(*truth) - positionOf(estimate)).norm(), kAllowed)
        << "at " << estimate.header.stamp;
  }
  EXPECT_GT(compared, 20u);
  EXPECT_LT((positionOf(real.back()) - goal).norm(), kAllowed);
  EXPECT_GT((positionOf(real.back()) - positionOf(begin)).norm(), 0.3) << "it moved";
}

}  // namespace
}  // namespace grid_path_planner::nodes
