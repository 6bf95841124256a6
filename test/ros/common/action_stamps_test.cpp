#include "ros/common/action/action_stamps.h"

#include <gtest/gtest.h>

namespace grid_path_planner::nodes {
namespace {

const ros::Time kLast(~0U, 999'999'999);

TEST(ActionStamps, GoalsAreInTheOrderInWhichTheyCome) {
  ActionStamps stamps;
  const ros::Time first = stamps.ofGoal(ros::Time(100.0));
  EXPECT_EQ(first, ros::Time(100.0));
  EXPECT_GT(stamps.ofGoal(ros::Time(100.0)), first);
  EXPECT_GT(stamps.ofGoal(ros::Time(1.0)), first) << "time began anew";
}

TEST(ActionStamps, ACancelOfTheFutureEndsWhatHasCome) {
  ActionStamps stamps;
  const ros::Time before = stamps.ofGoal(ros::Time(100.0));
  const ros::Time cancel = stamps.ofCancel(kLast, ros::Time(100.0));
  EXPECT_GE(cancel, before);
  EXPECT_GT(stamps.ofGoal(ros::Time(100.0)), cancel) << "and nothing later";
}

TEST(ActionStamps, OtherCancelsMeanWhatTheySay) {
  ActionStamps stamps;
  EXPECT_EQ(stamps.ofCancel({}, ros::Time(100.0)), ros::Time());
  EXPECT_EQ(stamps.ofCancel(ros::Time(50.0), ros::Time(100.0)), ros::Time(50.0));
}

}  // namespace
}  // namespace grid_path_planner::nodes
