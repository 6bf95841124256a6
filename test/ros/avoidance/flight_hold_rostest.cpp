// Who holds the vehicle, and what was given before: what local_planner begins to fly, and whether it waits.
#include "ros/avoidance/flight_hold.h"

#include <gtest/gtest.h>

#include <vector>

namespace grid_path_planner::nodes {
namespace {

const char* const kPaused = "paused until ~resume";

class FlightHoldTest : public testing::Test {
 protected:
  void tap() {
    hold_.manual(true);
    hold_.manual(false);
  }
  void fly() {
    ASSERT_TRUE(hold_.begin(hold_.handovers()));
    plan(true);
  }
  bool plan(bool flies) { return hold_.notice(now_ += ros::Duration(0.1), flies); }
  std::string why() const { return hold_.why(0.0); }

  // With what was told last.
  class Told : public FlightHold {
   public:
    Told() : FlightHold([this](unsigned handovers) { handovers_ = handovers; }) {}
    unsigned handovers() const { return handovers_; }

   private:
    unsigned handovers_ = 0;
  };

  Told hold_;
  ros::Time now_{100.0};
};

TEST_F(FlightHoldTest, ATapWithinThePlanPeriodOfItsGoalPausesTheFlight) {
  ASSERT_TRUE(hold_.begin(0));
  tap();
  EXPECT_EQ(why(), kPaused);
  EXPECT_TRUE(plan(true)) << "and the node says so";
  EXPECT_EQ(hold_.handovers(), 0U);
}

// What was seen before, by reading: of a joystick that commanded when the goal came, and was let go before the next plan,
// nothing was left.
TEST_F(FlightHoldTest, AGoalThatCameWhileAJoystickCommandedWaits) {
  hold_.manual(true);
  ASSERT_TRUE(hold_.begin(1));
  hold_.manual(false);
  EXPECT_EQ(why(), kPaused);
}

// It was asked once a plan whether a joystick commands: a tap between two plans was not seen.
TEST_F(FlightHoldTest, WhatWasGivenBeforeATapIsNotBegunAfterwards) {
  tap();
  EXPECT_EQ(hold_.handovers(), 2U);
  for (const unsigned given : {0U, 1U}) EXPECT_FALSE(hold_.begin(given)) << given;
  EXPECT_TRUE(hold_.begin(2));
}

TEST_F(FlightHoldTest, APauseEndsByHandOnly) {
  fly();
  EXPECT_TRUE(hold_.pause(true).done);
  plan(false);
  plan(false);
  fly();
  EXPECT_EQ(why(), kPaused) << "the flight before ended meanwhile";
  EXPECT_TRUE(hold_.resume(true).done);
  EXPECT_EQ(why(), "");
  plan(false);
  EXPECT_FALSE(hold_.resume(false).done);
  EXPECT_TRUE(hold_.pause(false).done);
  fly();
  EXPECT_EQ(why(), kPaused);
  EXPECT_TRUE(hold_.endPause()) << "by ~cancel";
  EXPECT_EQ(why(), "");
  EXPECT_FALSE(hold_.endPause());
}

TEST_F(FlightHoldTest, AJoystickThatCommandsIsNotResumed) {
  fly();
  hold_.manual(true);
  EXPECT_FALSE(hold_.resume(true).done);
  hold_.manual(false);
  EXPECT_EQ(why(), kPaused);
  EXPECT_TRUE(hold_.resume(true).done);
}

}  // namespace
}  // namespace grid_path_planner::nodes
