#include <sensor_msgs/Joy.h>

#include <cmath>

#include "fuzz/fuzz_target.h"
#include "fuzz/messages/fuzz_messages.h"
#include "grid_path_planner/following/joystick.h"

namespace grid_path_planner::fuzz {
namespace {

std::vector<std::string> seedsOfJoysticks() {
  sensor_msgs::Joy joy;
  joy.axes = {0.1f, -0.5f, 0.0f, 1.0f, 0.25f, 0.0f, 0.0f, 0.0f};
  joy.buttons = {0, 0, 0, 0, 1, 1, 0, 0};
  return {bytesOf(joy)};
}

FUZZ_TARGET(joy_message, seedsOfJoysticks) {
  const auto joy = messageOf<sensor_msgs::Joy>(input);
  if (!joy) return;
  following::JoystickState state;
  state.axes.assign(joy->axes.begin(), joy->axes.end());
  for (const auto button : joy->buttons) state.buttons.push_back(button != 0);
  mayRefuse([&] {
    const auto velocity = following::joystickVelocity({}, state);
    if (!velocity) return;
    for (const double part : {velocity->surge, velocity->sway, velocity->heave, velocity->yaw_rate})
      mustHold(std::abs(part) < 2.0, "the velocity is no larger than its scale");
  });
}

}  // namespace
}  // namespace grid_path_planner::fuzz
