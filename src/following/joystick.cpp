#include "grid_path_planner/following/joystick.h"

#include <cmath>
#include <cstddef>
#include <string>

namespace grid_path_planner::following {

using base::BodyVelocity;
using base::InputError;

namespace {

constexpr int kNone = -1;
constexpr double kRounding = 1e-3;

std::size_t indexOf(const char* name, int number, std::size_t count) {
  if (number < 0 || static_cast<std::size_t>(number) >= count)
    throw InputError(std::string(name) + " is " + std::to_string(number) +
                     ", but the joystick has " + std::to_string(count) + ", numbered from 0");
  return static_cast<std::size_t>(number);
}

bool isHeld(const char* name, int button, const JoystickState& state) {
  return state.buttons[indexOf(name, button, state.buttons.size())];
}

double deflection(const char* name, int axis, double dead_zone, const JoystickState& state) {
  if (axis == kNone) return 0.0;
  const double value = state.axes[indexOf(name, axis, state.axes.size())];
  if (!(std::abs(value) <= 1.0 + kRounding))
    throw InputError(std::string(name) + " must be a number from -1 to 1, got " +
                     std::to_string(value));
  const double beyond = std::abs(value) - dead_zone;
  return beyond <= 0.0 ? 0.0 : std::copysign(beyond / (1.0 - dead_zone), value);
}

}  // namespace

std::optional<BodyVelocity> joystickVelocity(const JoystickOptions& o, const JoystickState& state) {
  if (o.deadman_button != kNone && !isHeld("deadman_button", o.deadman_button, state)) return {};
  const bool fast = o.fast_button != kNone && isHeld("fast_button", o.fast_button, state);
  const double factor = fast ? o.fast_factor : 1.0;
  const auto velocity = [&](const char* name, int axis, double scale) {
    return factor * scale * deflection(name, axis, o.dead_zone, state);
  };
  return BodyVelocity{velocity("surge_axis", o.surge_axis, o.surge_scale),
                      velocity("sway_axis", o.sway_axis, o.sway_scale),
                      velocity("heave_axis", o.heave_axis, o.heave_scale),
                      velocity("yaw_axis", o.yaw_axis, o.yaw_scale)};
}

}  // namespace grid_path_planner::following
