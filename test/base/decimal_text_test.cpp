#include "grid_path_planner/base/decimal_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace grid_path_planner::base {
namespace {

TEST(DecimalText, IsAsShortAsItWasTyped) {
  EXPECT_EQ(decimalText(-1.0), "-1");
  EXPECT_EQ(decimalText(0.05), "0.05");
  EXPECT_EQ(decimalText(10.0), "10");
  EXPECT_EQ(decimalText(-2500.0), "-2500");
  EXPECT_EQ(decimalText(1e300), "1e+300");
  EXPECT_EQ(decimalText(0.0), "0");
  EXPECT_EQ(decimalText(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(decimalText(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(decimalText(std::numeric_limits<double>::infinity()), "inf");
}

TEST(DecimalText, ReadsBackAsTheSame) {
  std::mt19937_64 random(20261122);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 99));
    EXPECT_EQ(std::stod(decimalText(value)), value);
  }
}

}  // namespace
}  // namespace grid_path_planner::base
