#include "grid_path_planner/ros/conversions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "grid_path_planner/base/errors.h"
#include "ros/messages/pose_reading.h"

namespace grid_path_planner::nodes {

using base::InputError;
using path::Path;
using path::Pose;

namespace {

geometry_msgs::Pose message(double x, double y, double z, double qx, double qy, double qz,
                            double qw) {
  geometry_msgs::Pose pose;
  pose.position.x = x;
  pose.position.y = y;
  pose.position.z = z;
  pose.orientation.x = qx;
  pose.orientation.y = qy;
  pose.orientation.z = qz;
  pose.orientation.w = qw;
  return pose;
}

TEST(PoseFromMessage, TakesPositionAndYaw) {
  const Pose pose = poseFromMessage(message(1, 2, 3, 0, 0, std::sqrt(0.5), std::sqrt(0.5)));
  EXPECT_EQ(pose.position, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(pose.yaw, M_PI / 2, 1e-12);
}

TEST(PoseFromMessage, BadQuaternionsAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(poseFromMessage(message(0, 0, 0, 0, 0, 0, 0)), InputError) << "zero";
  EXPECT_THROW(poseFromMessage(message(0, 0, 0, 0, 0, 0, 2)), InputError) << "not normalised";
  EXPECT_THROW(poseFromMessage(message(0, 0, 0, 0, 0, nan, 1)), InputError);
  EXPECT_THROW(poseFromMessage(message(0, 0, 0, 0.5, 0, 0, std::sqrt(0.75))), InputError) << "roll";
  EXPECT_THROW(poseFromMessage(message(0, 0, 0, 0, 0.1, 0, std::sqrt(0.99))), InputError)
      << "pitch";
  EXPECT_NO_THROW(poseFromMessage(message(0, 0, 0, 0, 0, 0.745, 0.663))) << "three digits";
}

// What was seen: goals that move_base drives to were refused, of 3-D estimates and of quaternions that were typed.
TEST(PoseFromMessage, WhatMoveBaseTakesIsTaken) {
  const double roll = 1.5 * M_PI / 180.0;
  const Pose tilted =
      poseFromMessage(message(1, 2, 3, std::sin(roll / 2), 0, 0, std::cos(roll / 2)));
  EXPECT_NEAR(tilted.yaw, 0.0, 1e-12);
  EXPECT_NEAR(
      poseFromMessage(message(0, 0, 0, 0, 0, 0.98 * std::sin(0.3), 0.98 * std::cos(0.3))).yaw, 0.6,
      1e-12);
  const double limit = 2.56 * M_PI / 180.0, beyond = 2.6 * M_PI / 180.0;
  EXPECT_NO_THROW(
      poseFromMessage(message(0, 0, 0, 0, std::sin(limit / 2), 0, std::cos(limit / 2))));
  EXPECT_THROW(poseFromMessage(message(0, 0, 0, 0, std::sin(beyond / 2), 0, std::cos(beyond / 2))),
               InputError);
}

TEST(ReadPose, SaysWhatItTookAndLeavesTheLimitToTheMap) {
  EXPECT_EQ(readPose(message(0, 0, 0, 0, 0, 0.745, 0.663), ZeroHeading::REFUSED).told, nullptr);
  EXPECT_NE(readPose(message(0, 0, 0, 0.013, 0, 0, 1), ZeroHeading::REFUSED).told, nullptr);
  EXPECT_NE(readPose(message(0, 0, 0, 0, 0, 0, 0.98), ZeroHeading::REFUSED).told, nullptr);
  EXPECT_EQ(readPose(message(5e5, 4.5e6, 0, 0, 0, 0, 1), ZeroHeading::REFUSED).pose.position.y(),
            4.5e6);
  EXPECT_TRUE(std::isnan(readPose(message(0, 0, 0, 0, 0, 0, 0), ZeroHeading::ANY).pose.yaw));
  EXPECT_THROW(readPose(message(0, 0, 0, 0, 0, 0, 0), ZeroHeading::REFUSED), InputError);
  EXPECT_THROW(readPose(message(0, 0, 0, 0, 0, 0, 1e-9), ZeroHeading::ANY), InputError);
}

TEST(PoseFromMessage, AbsurdCoordinatesAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(poseFromMessage(message(nan, 0, 0, 0, 0, 0, 1)), InputError);
  EXPECT_THROW(poseFromMessage(message(0, 1e180, 0, 0, 0, 0, 1)), InputError);
  EXPECT_THROW(poseFromMessage(message(0, 1.1e6, 0, 0, 0, 0, 1)), InputError);
  EXPECT_THROW(poseFromMessage(message(0, 0, -INFINITY, 0, 0, 0, 1)), InputError);
}

TEST(YawOf, IsThatOfATiltedVehicleToo) {
  // Roll 0.3 about x after yaw 1 about z.
  geometry_msgs::Quaternion q;
  q.w = std::cos(0.5) * std::cos(0.15);
  q.x = std::cos(0.5) * std::sin(0.15);
  q.y = std::sin(0.5) * std::sin(0.15);
  q.z = std::sin(0.5) * std::cos(0.15);
  EXPECT_NEAR(yawOf(q), 1.0, 1e-12);
}

TEST(PathConversion, NamesTheBadPoseAndDropsTheSlash) {
  nav_msgs::Path path;
  path.header.frame_id = "/map";
  path.poses.resize(2);
  path.poses[0].pose.orientation.w = 1.0;
  try {
    pathFromMessage(path);
    FAIL() << "the second pose has a zero quaternion";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("pose 2"), std::string::npos) << error.what();
  }
  path.poses[1].pose.orientation.w = 1.0;
  EXPECT_EQ(pathFromMessage(path).frame_id, "map");
}

TEST(PathConversionLaw, ThereAndBackIsTheSame) {
  std::mt19937 random(24);
  std::uniform_real_distribution<double> place(-1000.0, 1000.0);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  Path path;
  for (int i = 0; i < 100; ++i) {
    path.poses.emplace_back();
    path.poses.back().position = {place(random), place(random), place(random)};
    path.poses.back().yaw = angle(random);
  }
  const Path back = pathFromMessage(pathToMessage(path, ros::Time(1.0)));
  ASSERT_EQ(back.poses.size(), path.poses.size());
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    EXPECT_EQ(back.poses[i].position, path.poses[i].position);
    EXPECT_NEAR(back.poses[i].yaw, path.poses[i].yaw, 1e-12);
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
