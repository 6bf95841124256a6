// Times of ROS that are of any number.
#include "ros/guard/clock.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace grid_path_planner::nodes {
namespace {

ros::Time raw(std::uint32_t seconds, std::uint32_t nanoseconds) {
  ros::Time time;
  time.sec = seconds;
  time.nsec = nanoseconds;
  return time;
}

TEST(NormalizedTime, IsTheSameTimeWhereThereIsOne) {
  EXPECT_EQ(normalized(raw(7, 999'999'999)), raw(7, 999'999'999));
  EXPECT_EQ(normalized(raw(7, 1'000'000'000)), raw(8, 0));
  EXPECT_EQ(normalized(raw(7, 4'294'967'295)), raw(11, 294'967'295));
  EXPECT_EQ(normalized(ros::TIME_MAX), ros::TIME_MAX);
}

TEST(NormalizedTime, IsTheLastWhereItIsBeyond) {
  EXPECT_EQ(normalized(raw(4'294'967'295, 1'000'000'000)), ros::TIME_MAX);
  EXPECT_EQ(normalized(raw(4'294'967'292, 4'294'967'295)), ros::TIME_MAX);
  EXPECT_EQ(normalized(raw(4'294'967'291, 4'294'967'295)), raw(4'294'967'295, 294'967'295));
}

}  // namespace
}  // namespace grid_path_planner::nodes
