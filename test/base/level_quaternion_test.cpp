#include "grid_path_planner/base/level_quaternion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "support/error_text.h"

namespace grid_path_planner::base {
namespace {

using test::contains;
using test::errorText;

TEST(LevelQuaternion, YawComesBack) {
  for (int degrees = -179; degrees <= 179; ++degrees) {
    const double yaw = degrees * M_PI / 180.0;
    for (const double length : {1.0, -1.0, 0.5, 30.0})
      EXPECT_NEAR(
          yawOfLevelQuaternion(0, 0, length * std::sin(yaw / 2), length * std::cos(yaw / 2)), yaw,
          1e-12);
  }
  EXPECT_EQ(yawOfLevelQuaternion(0, 0, 0, 1), 0.0);
}

TEST(LevelQuaternion, WhatHasNoLevelYawIsRefusedWithItsNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(errorText([] { yawOfLevelQuaternion(0, 0, 0, 0); }),
            "orientation x 0 y 0 z 0 w 0 has length zero");
  EXPECT_TRUE(contains(errorText([] { yawOfLevelQuaternion(0.1, 0, 0, 0.995); }), "must be level"));
  EXPECT_TRUE(contains(errorText([] { yawOfLevelQuaternion(0, 0.1, 0, 0.995); }), "must be level"));
  EXPECT_TRUE(contains(errorText([] { yawOfLevelQuaternion(1, 0, 0, 0); }), "must be level"));
  EXPECT_TRUE(contains(errorText([&] { yawOfLevelQuaternion(0, 0, nan, 1); }), "must be finite"));
}

// octomap_server sets the position of its map's origin and leaves (0, 0, 0, 0): /projected_map was refused.
TEST(MapOrigin, ZerosAreYawZeroAndWhatIsNeitherIsRefused) {
  EXPECT_TRUE(isZeroQuaternion(0, -0.0, 0, 0));
  EXPECT_EQ(yawOfMapOrigin(0, 0, 0, 0), 0.0);
  EXPECT_FALSE(isZeroQuaternion(0, 0, 0, 1));
  EXPECT_NEAR(yawOfMapOrigin(0, 0, 0.98 * std::sin(0.2), 0.98 * std::cos(0.2)), 0.4, 1e-12);
  EXPECT_TRUE(contains(errorText([] { yawOfMapOrigin(0, 0, 0, 1e-9); }), "has length zero"));
  EXPECT_TRUE(contains(errorText([] { yawOfMapOrigin(0.1, 0, 0, 0.995); }), "must be level"));
}

// Yaw, then pitch, then roll, as vehicles turn: the pitch and the roll leave the yaw as it is.
TEST(YawAndTilt, OfAnyTurnIsThatOfItsXAxisAndItsZAxis) {
  for (const double yaw : {-3.0, -1.0, 0.0, 0.4, 2.5})
    for (const double pitch : {-1.2, -0.1, 0.0, 0.6})
      for (const double roll : {-2.5, -0.3, 0.0, 0.9}) {
        const Eigen::Quaterniond turn = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                        Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                        Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
        const YawAndTilt got =
            yawAndTiltOfQuaternion(3 * turn.x(), 3 * turn.y(), 3 * turn.z(), 3 * turn.w());
        EXPECT_NEAR(got.yaw, yaw, 1e-12);
        EXPECT_NEAR(std::cos(got.tilt), (turn * Eigen::Vector3d::UnitZ()).z(), 1e-12);
      }
}

TEST(LevelQuaternion, TheNoiseOfAFloatIsLevel) {
  EXPECT_NEAR(yawOfLevelQuaternion(1e-7, -1e-7, std::sqrt(0.5), std::sqrt(0.5)), M_PI / 2, 1e-6);
}

}  // namespace
}  // namespace grid_path_planner::base
