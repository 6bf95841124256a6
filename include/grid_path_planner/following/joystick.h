// A joystick's axes and buttons as a velocity of the vehicle.
//
//   JoystickOptions options;                        // axes and scales of a usual game pad
//   if (const auto velocity = joystickVelocity(options, {axes, buttons}))
//     vehicle.command(*velocity);
//
// Guaranteed: without its deadman button held there is no command at all, so that others may
// command the vehicle; a stick inside the dead zone commands exactly zero, and beyond it the speed
// grows evenly from zero. No state is kept. Not guaranteed: that what comes is recent; the caller
// knows when it came.
#pragma once

#include <optional>
#include <vector>

#include "grid_path_planner/base/body_velocity.h"
#include "grid_path_planner/base/options.h"

namespace grid_path_planner::following {

// The defaults are those of an Xbox pad under Linux: left stick surge and sway, right stick heave
// and yaw, left shoulder button deadman, right one fast.
struct JoystickOptions {
  int surge_axis = 1;
  int sway_axis = 0;
  int heave_axis = 4;
  int yaw_axis = 3;
  double surge_scale = 0.8;  // m/s at the end of the stick's travel; negative: reversed
  double sway_scale = 0.5;   // m/s
  double heave_scale = 0.4;  // m/s
  double yaw_scale = 0.8;    // rad/s
  double dead_zone = 0.05;   // share of the stick's travel
  int deadman_button = 4;
  int fast_button = 5;
  double fast_factor = 1.5;
};

template <class Visitor>
void visitOptions(JoystickOptions& o, Visitor&& visit) {
  const auto axis = [](const char* description) {
    return base::OptionInfo{description, "", -1, 255};
  };
  const auto scale = [](const char* description, const char* unit) {
    return base::OptionInfo{description, unit, -100.0, 100.0};
  };
  visit("surge_axis", o.surge_axis,
        axis("Axis that drives ahead and astern")
            .under("Sticks: numbers of the axes, from 0; -1: none. The defaults are those of an "
                   "Xbox pad under Linux"));
  visit("sway_axis", o.sway_axis, axis("Axis that drives sideways"));
  visit("heave_axis", o.heave_axis, axis("Axis that drives up and down"));
  visit("yaw_axis", o.yaw_axis, axis("Axis that turns"));
  visit("surge_scale", o.surge_scale,
        scale("Speed ahead at the end of the stick's travel; negative: reversed", "m/s"));
  visit("sway_scale", o.sway_scale,
        scale("Speed sideways at the end of the stick's travel", "m/s"));
  visit("heave_scale", o.heave_scale,
        scale("Speed upwards at the end of the stick's travel", "m/s"));
  visit("yaw_scale", o.yaw_scale, scale("Yaw rate at the end of the stick's travel", "rad/s"));
  visit("dead_zone", o.dead_zone,
        base::OptionInfo{
            "Share of a stick's travel that counts as its middle; larger for a worn stick", "", 0.0,
            0.9});
  visit("deadman_button", o.deadman_button,
        base::OptionInfo{
            "Button without which nothing is commanded; -1: the joystick always commands", "", -1,
            255}
            .under("Buttons: numbers from 0"));
  visit("fast_button", o.fast_button,
        base::OptionInfo{"Button that multiplies all scales while it is held; -1: none", "", -1,
                         255});
  visit("fast_factor", o.fast_factor,
        base::OptionInfo{"What the fast button multiplies all scales by", "", 0.01, 100.0});
}

struct JoystickState {
  std::vector<double> axes;   // -1..1 each
  std::vector<bool> buttons;  // whether it is held
};

// None while the deadman button is not held. Throws InputError naming the axis or button that the
// joystick lacks, or an axis that is not a number from -1 to 1 (a thousandth beyond is taken for
// rounding).
std::optional<base::BodyVelocity> joystickVelocity(const JoystickOptions& options,
                                                   const JoystickState& state);

}  // namespace grid_path_planner::following
