// Whether what local_planner flies is paused.
#include "ros/avoidance/flight_hold.h"

#include <gtest/gtest.h>

namespace grid_path_planner::nodes {
namespace {

class FlightHoldTest : public testing::Test {
 protected:
  void manual(bool is) {
    is_manual_ = is;
    hold_.manual(is);
  }
  void fly() {
    hold_.begin(is_manual_);
    plan(true);
  }
  bool plan(bool flies) { return hold_.notice(flies, is_manual_); }

  FlightHold hold_;
  bool is_manual_ = false;
};

TEST_F(FlightHoldTest, ATapWithinThePlanPeriodOfItsGoalPausesTheFlight) {
  hold_.begin(false);
  for (const bool is : {true, false}) manual(is);
  EXPECT_TRUE(hold_.paused());
  EXPECT_TRUE(plan(true)) << "and the node says so";
  EXPECT_FALSE(plan(true)) << "once";
}

// What was seen before, by reading: of a joystick that commanded when the goal came, and was let go before the next plan,
// nothing was left.
TEST_F(FlightHoldTest, AGoalThatCameWhileAJoystickCommandedWaits) {
  manual(true);
  EXPECT_FALSE(hold_.paused()) << "nothing is flown";
  hold_.begin(true);
  manual(false);
  EXPECT_TRUE(hold_.paused());
}

TEST_F(FlightHoldTest, APauseEndsByHandOnly) {
  fly();
  EXPECT_TRUE(hold_.pause(true).done);
  plan(false);
  plan(false);
  fly();
  EXPECT_TRUE(hold_.paused()) << "the flight before ended meanwhile";
  EXPECT_TRUE(hold_.resume(true, false).done);
  EXPECT_FALSE(hold_.paused());
  plan(false);
  EXPECT_FALSE(hold_.resume(false, false).done);
  EXPECT_TRUE(hold_.pause(false).done);
  fly();
  EXPECT_TRUE(hold_.paused());
  EXPECT_TRUE(hold_.endPause()) << "by ~cancel";
  EXPECT_FALSE(hold_.paused());
  EXPECT_FALSE(hold_.endPause());
}

TEST_F(FlightHoldTest, AJoystickThatCommandsIsNotResumed) {
  fly();
  manual(true);
  EXPECT_FALSE(hold_.resume(true, true).done);
  manual(false);
  EXPECT_TRUE(hold_.paused());
  EXPECT_TRUE(hold_.resume(true, false).done);
}

}  // namespace
}  // namespace grid_path_planner::nodes
