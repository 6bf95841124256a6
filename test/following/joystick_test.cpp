#include "grid_path_planner/following/joystick.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/error_text.h"
#include "support/option_laws.h"

namespace grid_path_planner::following {
namespace {

// A pad with its deadman button held and its sticks in the middle.
JoystickState held() {
  JoystickState state{std::vector<double>(8, 0.0), std::vector<bool>(11, false)};
  state.buttons[4] = true;
  return state;
}

TEST(JoystickOptions, AllHoldToTheLaws) {
  test::expectOptionLaws<JoystickOptions>();
}

TEST(Joystick, NothingIsCommandedWithoutTheDeadmanButton) {
  JoystickState state = held();
  state.axes[1] = 1.0;
  EXPECT_TRUE(joystickVelocity({}, state));
  state.buttons[4] = false;
  EXPECT_FALSE(joystickVelocity({}, state));
  JoystickOptions without;
  without.deadman_button = -1;
  EXPECT_TRUE(joystickVelocity(without, state));
}

TEST(Joystick, EveryAxisHasItsOwnScale) {
  JoystickOptions options;
  options.sway_scale = -0.25;
  JoystickState state = held();
  state.axes = {1.0, -1.0, 0.3, 1.0, -1.0, 0.0, 0.0, 0.0};
  const auto velocity = joystickVelocity(options, state);
  ASSERT_TRUE(velocity);
  EXPECT_DOUBLE_EQ(velocity->surge, -0.8);
  EXPECT_DOUBLE_EQ(velocity->sway, -0.25);
  EXPECT_DOUBLE_EQ(velocity->heave, -0.4);
  EXPECT_DOUBLE_EQ(velocity->yaw_rate, 0.8);
}

TEST(Joystick, TheFastButtonMultipliesAll) {
  JoystickState state = held();
  state.axes[1] = state.axes[3] = 1.0;
  state.buttons[5] = true;
  const auto velocity = joystickVelocity({}, state);
  ASSERT_TRUE(velocity);
  EXPECT_DOUBLE_EQ(velocity->surge, 1.5 * 0.8);
  EXPECT_DOUBLE_EQ(velocity->yaw_rate, 1.5 * 0.8);
}

TEST(Joystick, SpeedGrowsEvenlyFromZeroAtTheEdgeOfTheDeadZone) {
  JoystickOptions options;
  options.dead_zone = 0.2;
  const auto surge = [&](double deflection) {
    JoystickState state = held();
    state.axes[1] = deflection;
    return joystickVelocity(options, state)->surge;
  };
  EXPECT_EQ(surge(0.2), 0.0);
  EXPECT_EQ(surge(-0.19), 0.0);
  EXPECT_NEAR(surge(0.2 + 1e-6), 0.0, 1e-5);
  EXPECT_DOUBLE_EQ(surge(0.6), 0.4);
  EXPECT_DOUBLE_EQ(surge(-0.6), -0.4);
  EXPECT_DOUBLE_EQ(surge(1.0), 0.8);
}

TEST(Joystick, AnAxisMayBeLeftOut) {
  JoystickOptions options;
  options.heave_axis = -1;
  JoystickState state{{0.0, 1.0, 0.0, 0.0}, std::vector<bool>(6, true)};
  const auto velocity = joystickVelocity(options, state);
  ASSERT_TRUE(velocity);
  EXPECT_EQ(velocity->heave, 0.0);
}

TEST(Joystick, WhatTheJoystickLacksOrSendsWronglyIsNamed) {
  const auto refusal = [](const JoystickState& state) {
    return test::errorText([&] { joystickVelocity({}, state); });
  };
  EXPECT_EQ(refusal({{0.0, 0.0}, std::vector<bool>(6, true)}),
            "heave_axis is 4, but the joystick has 2, numbered from 0");
  EXPECT_EQ(refusal({std::vector<double>(5), {false, false}}),
            "deadman_button is 4, but the joystick has 2, numbered from 0");
  JoystickState state = held();
  state.axes[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(state), "yaw_axis must be a number from -1 to 1, got nan");
  state.axes[3] = 1.1;
  EXPECT_NE(refusal(state), "");
  state.axes[3] = 1.0005;
  EXPECT_EQ(refusal(state), "");
}

}  // namespace
}  // namespace grid_path_planner::following
