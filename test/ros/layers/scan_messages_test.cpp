#include "ros/layers/scan_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/error_text.h"

namespace grid_path_planner::nodes {
namespace {

using layers::ScanInMap;
using test::contains, test::errorText;

constexpr float kInf = std::numeric_limits<float>::infinity();

// Rays at 0, 90, 180 degrees and so on.
sensor_msgs::LaserScan scanOf(std::vector<float> ranges) {
  sensor_msgs::LaserScan scan;
  scan.angle_increment = static_cast<float>(M_PI / 2.0);
  scan.range_min = 0.5F;
  scan.range_max = 10.0F;
  scan.ranges = std::move(ranges);
  return scan;
}

// At x 2, y 3, looking along y.
Eigen::Isometry3d poseOfLaser() {
  return Eigen::Translation3d(2.0, 3.0, 0.0) *
         Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitZ());
}

TEST(ScanInMap, HasARayForEachThatMeasured) {
  const ScanInMap scan = scanInMap(scanOf({4.0F, 1.0F}), poseOfLaser(), false);
  EXPECT_EQ(scan.origin, Eigen::Vector2d(2.0, 3.0));
  ASSERT_EQ(scan.beams.size(), 2U);
  EXPECT_LT((scan.beams[0].end - Eigen::Vector2d(2.0, 7.0)).norm(), 1e-6);
  EXPECT_LT((scan.beams[1].end - Eigen::Vector2d(1.0, 3.0)).norm(), 1e-6);
  EXPECT_EQ(scan.beams[0].range, 4.0);
  EXPECT_TRUE(scan.beams[0].hit);
}

TEST(ScanInMap, WhatMeasuredNothingSaysNothing) {
  const auto silent = scanOf({std::nanf(""), -kInf, 0.4F, 10.1F, -3.0F});
  EXPECT_TRUE(scanInMap(silent, poseOfLaser(), true).beams.empty());
}

// Gazebo's laser has range_max where nothing came back, others one metre more, infinity, NaN or 0: a ring of obstacles.
TEST(ScanInMap, NoReturnIsNoHitHoweverItIsSaid) {
  for (const float range_min : {0.0F, 0.1F})
    for (const float no_return : {4.0F, 5.0F, kInf, std::nanf(""), 0.0F}) {
      sensor_msgs::LaserScan scan = scanOf(std::vector<float>(181, no_return));
      scan.angle_min = static_cast<float>(-M_PI / 2.0);
      scan.angle_increment = static_cast<float>(M_PI / 180.0);
      scan.range_min = range_min;
      scan.range_max = 4.0F;
      scan.ranges[135] = 3.0F;  // at 45 degrees
      checkScan(scan);
      const ScanInMap in_map = scanInMap(scan, Eigen::Isometry3d::Identity(), false);
      ASSERT_EQ(in_map.beams.size(), 1U) << no_return;
      EXPECT_TRUE(in_map.beams[0].hit);
      EXPECT_LT((in_map.beams[0].end - 3.0 * std::sqrt(0.5) * Eigen::Vector2d(1.0, 1.0)).norm(),
                1e-5);
    }
}

// pointcloud_to_laserscan's range_max is infinite unless it is set: every scan was refused.
TEST(ScanInMap, ALaserMayReachAnywhere) {
  sensor_msgs::LaserScan scan = scanOf({4.0F, kInf, 2e4F});
  scan.range_max = kInf;
  checkScan(scan);
  const ScanInMap in_map = scanInMap(scan, poseOfLaser(), true);
  ASSERT_EQ(in_map.beams.size(), 2U);
  EXPECT_TRUE(in_map.beams[0].hit);
  EXPECT_FALSE(in_map.beams[1].hit);
  EXPECT_EQ(in_map.beams[1].range, 1e4);
}

TEST(ScanInMap, InfinityIsFreeWhereItIsAskedFor) {
  EXPECT_TRUE(scanInMap(scanOf({kInf}), poseOfLaser(), false).beams.empty());
  const ScanInMap scan = scanInMap(scanOf({kInf}), poseOfLaser(), true);
  ASSERT_EQ(scan.beams.size(), 1U);
  EXPECT_FALSE(scan.beams[0].hit);
  EXPECT_EQ(scan.beams[0].range, 10.0);
}

TEST(ScanInMap, ATiltedLaserIsLaidDownOnTheMap) {
  const Eigen::Isometry3d pose(Eigen::AngleAxisd(M_PI / 3.0, Eigen::Vector3d::UnitY()));
  const ScanInMap scan = scanInMap(scanOf({4.0F}), pose, false);
  EXPECT_LT((scan.beams.at(0).end - Eigen::Vector2d(2.0, 0.0)).norm(), 1e-6);
  EXPECT_EQ(scan.beams[0].range, 4.0) << "as it was measured";
}

TEST(Scans, ThatCannotBeMeantAreRefused) {
  const auto refusal = [](void (*spoil)(sensor_msgs::LaserScan&)) {
    sensor_msgs::LaserScan scan = scanOf({1.0F});
    spoil(scan);
    return errorText([&] { checkScan(scan); });
  };
  EXPECT_EQ(refusal([](auto&) {}), "");
  EXPECT_TRUE(contains(refusal([](auto& s) { s.angle_min = kInf; }), "angles"));
  EXPECT_TRUE(contains(refusal([](auto& s) { s.angle_increment = std::nanf(""); }), "angles"));
  EXPECT_TRUE(contains(refusal([](auto& s) { s.range_max = 1.1e4F; }), "range_max"));
  EXPECT_TRUE(contains(refusal([](auto& s) { s.range_min = 20.0F; }), "range_max"));
  EXPECT_TRUE(contains(refusal([](auto& s) { s.ranges.clear(); }), "no ranges"));
  EXPECT_TRUE(contains(refusal([](auto& s) { s.ranges.resize(20001); }), "20001 ranges"));
  EXPECT_TRUE(contains(refusal([](auto& s) { s.intensities.resize(20001); }), "20001 intensities"));
}

// tf2 takes what is finite, whatever its size.
TEST(Scans, OfALaserOutOfThisWorldAreRefused) {
  Eigen::Isometry3d pose = poseOfLaser();
  EXPECT_EQ(errorText([&] { checkScanPose(pose); }), "");
  pose.translation().x() = 1e200;
  EXPECT_TRUE(contains(errorText([&] { checkScanPose(pose); }), "out of this world"));
  pose.translation().x() = std::nan("");
  EXPECT_TRUE(contains(errorText([&] { checkScanPose(pose); }), "out of this world"));
}

}  // namespace
}  // namespace grid_path_planner::nodes
