#include "ros/gate/manual_control.h"

#include <gtest/gtest.h>

#include "ros/support/wait.h"

namespace grid_path_planner::nodes {
namespace {

TEST(ManualControl, SaysWhenItChanges) {
  ManualControl joystick;
  EXPECT_FALSE(joystick.commands());
  EXPECT_FALSE(joystick.hear(false));
  EXPECT_TRUE(joystick.hear(true));
  EXPECT_FALSE(joystick.hear(true));
  EXPECT_TRUE(joystick.commands());
  EXPECT_FALSE(joystick.expire());
  EXPECT_TRUE(joystick.hear(false));
  EXPECT_FALSE(joystick.commands());
}

// A joystick's node that is killed says nothing any more: that, too, is letting go.
TEST(ManualControl, EndsOnceWhenNothingIsHeard) {
  ManualControl joystick;
  joystick.hear(true);
  EXPECT_TRUE(test::waitFor([&] { return joystick.expire(); }));
  EXPECT_FALSE(joystick.commands());
  EXPECT_FALSE(joystick.expire());
  EXPECT_TRUE(joystick.hear(true));
}

TEST(ManualControl, AnEndThatNobodyHasNoticedIsToldWithTheNextMessage) {
  ManualControl joystick;
  joystick.hear(true);
  EXPECT_TRUE(test::waitFor([&] { return !joystick.commands(); }));
  EXPECT_TRUE(joystick.hear(false));
}

}  // namespace
}  // namespace grid_path_planner::nodes
