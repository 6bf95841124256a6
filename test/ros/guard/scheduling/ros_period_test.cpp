// `/clock` at the last second that a time can hold ended path_planner with a replan_period: roscpp's timer of ROS
// time adds its period to the time, which throws in a thread that nobody guards.
#include "ros/guard/scheduling/ros_period.h"

#include <gtest/gtest.h>

namespace grid_path_planner::nodes {
namespace {

RosPeriod begunAt(double seconds) {
  RosPeriod period;
  period.begin(ros::Time(seconds));
  return period;
}

TEST(RosPeriod, IsOverOnceInItsTime) {
  RosPeriod period = begunAt(100.0);
  EXPECT_FALSE(period.isOver(ros::Time(101.9), 2.0));
  EXPECT_TRUE(period.isOver(ros::Time(102.0), 2.0));
  EXPECT_FALSE(period.isOver(ros::Time(103.9), 2.0));
  EXPECT_TRUE(period.isOver(ros::Time(104.0), 2.0));
}

TEST(RosPeriod, TimeThatStandsIsNotOver) {
  RosPeriod period = begunAt(100.0);
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(period.isOver(ros::Time(100.0), 0.001));
}

TEST(RosPeriod, TimeThatGoesBackBeginsAnew) {
  RosPeriod period = begunAt(1e9);
  EXPECT_FALSE(period.isOver(ros::Time(5.0), 2.0));
  EXPECT_FALSE(period.isOver(ros::Time(6.0), 2.0));
  EXPECT_TRUE(period.isOver(ros::Time(7.0), 2.0));
}

TEST(RosPeriod, BearsTheEndsOfTime) {
  RosPeriod period = begunAt(0.0);
  EXPECT_TRUE(period.isOver(ros::TIME_MAX, 86400.0));
  EXPECT_FALSE(period.isOver(ros::TIME_MAX, 86400.0));
  EXPECT_FALSE(period.isOver(ros::Time(0.0), 86400.0));
  EXPECT_TRUE(period.isOver(ros::Time(86400.0), 86400.0));
}

}  // namespace
}  // namespace grid_path_planner::nodes
