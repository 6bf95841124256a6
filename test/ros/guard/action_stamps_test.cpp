#include "ros/guard/action/action_stamps.h"

#include <gtest/gtest.h>

namespace grid_path_planner::nodes {
namespace {

const ros::Time kLast(~0U, 999'999'999);

TEST(ActionStamps, GoalsAreInTheOrderInWhichTheyCome) {
  ActionStamps stamps;
  const ros::Time first = stamps.ofGoal({}, ros::Time(100.0));
  EXPECT_EQ(first, ros::Time(100.0));
  EXPECT_GT(stamps.ofGoal(kLast, ros::Time(100.0)), first);
  EXPECT_GT(stamps.ofGoal({}, ros::Time(1.0)), first) << "time began anew";
}

TEST(ActionStamps, ACancelOfTheFutureEndsWhatHasCome) {
  ActionStamps stamps;
  const ros::Time before = stamps.ofGoal({}, ros::Time(100.0));
  const ros::Time cancel = stamps.ofCancel(kLast, ros::Time(100.0));
  EXPECT_GE(cancel, before);
  EXPECT_GT(stamps.ofGoal({}, ros::Time(100.0)), cancel) << "and nothing later";
}

// A stranger's /clock said the last second that a ros::Time can hold; every later goal threw, for as long as the node
// lived.
TEST(ActionStamps, GoalsAreTakenAfterAClockAtTheEndOfTime) {
  ActionStamps stamps;
  EXPECT_EQ(stamps.ofGoal({}, kLast), kLast);
  EXPECT_EQ(stamps.ofGoal({}, kLast), kLast);
  EXPECT_EQ(stamps.ofGoal({}, ros::Time(100.0)), kLast) << "not before the one before";
  EXPECT_EQ(stamps.ofCancel({}, ros::Time(100.0)), ros::Time());
}

// Found by the fuzzer: a message's time may have more than 999,999,999 ns, and then be beyond the last that there is. Every
// later goal threw.
TEST(ActionStamps, GoalsAreTakenAfterATimeBeyondTheLast) {
  const ros::Time odd = [] {
    ros::Time time;
    time.sec = time.nsec = ~0U;
    return time;
  }();
  ActionStamps stamps;
  EXPECT_EQ(stamps.ofGoal(odd, odd), kLast);
  EXPECT_EQ(stamps.ofCancel(odd, odd), kLast);
  EXPECT_EQ(stamps.ofGoal(odd, odd), kLast);
  EXPECT_EQ(stamps.ofGoal({}, ros::Time(100.0)), kLast);
}

TEST(ActionStamps, OtherCancelsMeanWhatTheySay) {
  ActionStamps stamps;
  EXPECT_EQ(stamps.ofCancel({}, ros::Time(100.0)), ros::Time());
  EXPECT_EQ(stamps.ofCancel(ros::Time(50.0), ros::Time(100.0)), ros::Time(50.0));
}

// The cancel of a goal that had come a millisecond after it was sent did nothing, and the vehicle drove on.
TEST(ActionStamps, ACancelIsOfTheGoalsThatWereStampedUntilThen) {
  ActionStamps stamps;
  const ros::Time first = stamps.ofGoal(ros::Time(10.0), ros::Time(10.2));
  const ros::Time second = stamps.ofGoal(ros::Time(10.1), ros::Time(10.3));
  const ros::Time cancel = stamps.ofCancel(ros::Time(10.05), ros::Time(10.4));
  EXPECT_GE(cancel, first);
  EXPECT_LT(cancel, second);
  EXPECT_GE(stamps.ofCancel(ros::Time(10.1), ros::Time(10.4)), second);
}

TEST(ActionStamps, AGoalThatItsCancelOvertookIsCancelledAndAnotherIsNot) {
  ActionStamps stamps;
  const ros::Time cancel = stamps.ofCancel(ros::Time(10.0), ros::Time(10.0));
  EXPECT_LE(stamps.ofGoal(ros::Time(9.9), ros::Time(10.1)), cancel);
  EXPECT_GT(stamps.ofGoal(ros::Time(10.0), ros::Time(10.0)), cancel) << "given at once after it";
  EXPECT_GT(stamps.ofGoal({}, ros::Time(10.0)), cancel);
  stamps.timeWentBack();
  EXPECT_GT(stamps.ofGoal(ros::Time(2.0), ros::Time(2.0)), cancel);
}

// A client whose clock was an hour behind gave goals for an hour after a cancel with a stamp, and each was cancelled.
TEST(ActionStamps, AGoalOfAClockAnHourBehindWasNotOvertaken) {
  ActionStamps stamps;
  const ros::Time cancel = stamps.ofCancel(ros::Time(5000.0), ros::Time(5000.0));
  EXPECT_GT(stamps.ofGoal(ros::Time(1401.0), ros::Time(5001.0)), cancel);
}

}  // namespace
}  // namespace grid_path_planner::nodes
