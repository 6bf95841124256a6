#include "grid_path_planner/base/level_quaternion.h"

#include <gtest/gtest.h>

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

TEST(LevelQuaternion, TheNoiseOfAFloatIsLevel) {
  EXPECT_NEAR(yawOfLevelQuaternion(1e-7, -1e-7, std::sqrt(0.5), std::sqrt(0.5)), M_PI / 2, 1e-6);
}

}  // namespace
}  // namespace grid_path_planner::base
