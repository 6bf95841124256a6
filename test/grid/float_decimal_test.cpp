#include "grid/float_decimal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace grid_path_planner::grid {
namespace {

TEST(Resolution, WhatWasMeantComesBackFromAFloat) {
  EXPECT_EQ(floatToDecimal(0.05f), 0.05);
  EXPECT_EQ(floatToDecimal(0.123456f), 0.123456);
  EXPECT_EQ(floatToDecimal(0.5f), 0.5);
  EXPECT_EQ(floatToDecimal(-2.5f), -2.5);
  EXPECT_TRUE(std::isnan(floatToDecimal(std::nanf(""))));
  EXPECT_TRUE(std::isinf(floatToDecimal(INFINITY)));
}

TEST(Resolution, ANumberThatIsNoFloatStays) {
  EXPECT_EQ(printedFloatToDecimal(0.05000000074505806), 0.05);  // as rostopic echo prints it
  EXPECT_EQ(printedFloatToDecimal(0.05), 0.05);
  EXPECT_EQ(printedFloatToDecimal(0.0500000001), 0.0500000001);
  EXPECT_EQ(printedFloatToDecimal(1e300), 1e300);
}

}  // namespace
}  // namespace grid_path_planner::grid
