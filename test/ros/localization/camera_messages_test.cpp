#include "ros/localization/camera_messages.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/error_text.h"

namespace grid_path_planner::nodes {
namespace {

using sensor_msgs::CameraInfo;
using test::contains;

CameraInfo rightInfo() {
  CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.distortion_model = "plumb_bob";
  info.D = {0.1, -0.02, 0.001, 0.002, 0.0};
  info.K = {468.0, 0.0, 319.5, 0.0, 469.0, 239.5, 0.0, 0.0, 1.0};
  return info;
}

template <class Change>
std::string errorAfter(const Change& change) {
  CameraInfo info = rightInfo();
  change(info);
  return test::errorText([&] { calibrationOf(info); });
}

TEST(CameraMessages, ACalibrationIsTakenAsItIs) {
  const vision::CameraCalibration c = calibrationOf(rightInfo());
  EXPECT_EQ(c.width, 640);
  EXPECT_EQ(c.height, 480);
  EXPECT_EQ(c.fx, 468.0);
  EXPECT_EQ(c.fy, 469.0);
  EXPECT_EQ(c.cx, 319.5);
  EXPECT_EQ(c.cy, 239.5);
  EXPECT_EQ(c.distortion.size(), 5u);
}

TEST(CameraMessages, ALensWithoutDistortionHasNone) {
  CameraInfo info = rightInfo();
  info.D.assign(5, 0.0);
  EXPECT_TRUE(calibrationOf(info).distortion.empty());
}

// A driver without a calibration file publishes zeros.
TEST(CameraMessages, WhatIsNoCalibrationIsRefusedWithASentence) {
  EXPECT_EQ(errorAfter([](CameraInfo&) {}), "");
  EXPECT_TRUE(contains(errorAfter([](CameraInfo& i) { i.K.fill(0.0); }), "not calibrated"));
  EXPECT_TRUE(
      contains(errorAfter([](CameraInfo& i) { i.K[2] = std::numeric_limits<double>::quiet_NaN(); }),
               "not calibrated"));
  EXPECT_TRUE(contains(errorAfter([](CameraInfo& i) { i.D[1] = HUGE_VAL; }), "finite"));
  EXPECT_TRUE(contains(errorAfter([](CameraInfo& i) { i.width = 0; }), "0 x 480 pixels"));
  EXPECT_TRUE(
      contains(errorAfter([](CameraInfo& i) { i.height = 4294967295u; }), "640 x 4294967295"));
  EXPECT_TRUE(contains(errorAfter([](CameraInfo& i) { i.D.resize(4); }), "it has 4"));
  EXPECT_TRUE(contains(errorAfter([](CameraInfo& i) { i.distortion_model = "equidistant"; }),
                       "must be plumb_bob"));
  EXPECT_TRUE(contains(errorAfter([](CameraInfo& i) { i.binning_x = 2; }), "binning"));
  EXPECT_TRUE(contains(errorAfter([](CameraInfo& i) { i.roi.width = 100; }), "roi"));
  EXPECT_TRUE(contains(errorAfter([](CameraInfo& i) { i.K[1] = 1.0; }), "skew"));
}

}  // namespace
}  // namespace grid_path_planner::nodes
