#include "ros/avoidance/cloud_frames.h"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <limits>

#include "support/error_text.h"

namespace grid_path_planner::nodes {
namespace {

using avoidance::PilotOptions;
using test::contains, test::errorText;

// A column of pixels, each at (x, 0, 0).
sensor_msgs::PointCloud2 columnOf(const std::vector<float>& xs, std::uint32_t width = 1) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = "/camera";
  cloud.header.stamp = ros::Time(1000.5);
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(xs.size());
  sensor_msgs::PointCloud2Iterator<float> point(cloud, "x");
  for (const float x : xs) {
    point[0] = x;
    point[1] = point[2] = 0.0F;
    ++point;
  }
  cloud.width = width;
  cloud.height = static_cast<std::uint32_t>(xs.size()) / width;
  cloud.row_step = cloud.width * cloud.point_step;
  return cloud;
}

std::string refusalOf(const sensor_msgs::PointCloud2& cloud, const PilotOptions& options) {
  return errorText([&] { frameOf(cloud, Eigen::Isometry3d::Identity(), std::nullopt, options); });
}

TEST(FrameOfACloud, HasItsPointsItsTimeAndThePlaceOfItsSensor) {
  const Eigen::Isometry3d pose(Eigen::Translation3d(1.0, 2.0, 3.0));
  const avoidance::Frame frame = frameOf(columnOf({2.0F, 3.0F}, 2), pose, std::nullopt, {});
  EXPECT_EQ(frame.time, 1000.5);
  EXPECT_TRUE(frame.map_from_sensor.isApprox(pose));
  EXPECT_EQ(frame.points, (std::vector<float>{2.0F, 0.0F, 0.0F, 3.0F, 0.0F, 0.0F}));
  EXPECT_EQ(frame.width, 2);
  EXPECT_EQ(frame.height, 1);
  EXPECT_FALSE(frame.pinhole);
}

// A covered lens was made good by another sensor that sees.
TEST(FrameOfACloud, OneByWhichNothingIsKnownIsRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  PilotOptions options;
  const auto far = static_cast<float>(options.range_max + 1.0);
  EXPECT_EQ(refusalOf(columnOf({}), options), "it holds no point");
  EXPECT_TRUE(contains(refusalOf(columnOf({nan, far}), options), "holds no point within range"));
  EXPECT_EQ(refusalOf(columnOf({nan, 2.0F}), options), "");
  const auto organised = columnOf({nan, nan, nan, nan}, 2);
  EXPECT_TRUE(contains(refusalOf(organised, options), "holds no point within range"));
  options.no_return_clears = 10.0;
  EXPECT_EQ(refusalOf(organised, options), "") << "what returns nothing is free";
}

TEST(FrameOfACloud, OneOfTooManyPointsIsRefusedBeforeTheyAreRead) {
  sensor_msgs::PointCloud2 cloud = columnOf({2.0F});
  cloud.width = cloud.height = 100000;
  EXPECT_TRUE(contains(refusalOf(cloud, {}), "it has 10000000000 points, more than"));
}

TEST(FrameOfACloud, ACameraOfAnotherFrameOrSizeIsNotItsOwn) {
  const auto cloud = columnOf({2.0F, 2.0F}, 2);
  sensor_msgs::CameraInfo camera;
  camera.header.frame_id = "camera";
  camera.width = 2;
  camera.height = 1;
  camera.K = {300.0, 0.0, 1.0, 0.0, 200.0, 0.5, 0.0, 0.0, 1.0};
  const auto pinhole = [&] {
    return frameOf(cloud, Eigen::Isometry3d::Identity(), camera, {}).pinhole;
  };
  ASSERT_TRUE(pinhole());
  EXPECT_EQ(pinhole()->fx, 300.0);
  EXPECT_EQ(pinhole()->cy, 0.5);
  camera.header.frame_id = "other";
  EXPECT_FALSE(pinhole());
  camera.header.frame_id = "camera";
  camera.width = 4;
  EXPECT_FALSE(pinhole());
}

}  // namespace
}  // namespace grid_path_planner::nodes
