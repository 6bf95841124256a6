// The parameters of the node `teleop_joy`.
#pragma once

#include "grid_path_planner/simulation/joystick.h"

namespace grid_path_planner {

struct TeleopJoyOptions {
  JoystickOptions joystick;
  double joy_timeout = 0.5;    // s, wall time
  double command_rate = 20.0;  // Hz, wall time
};

template <class Visitor>
void visitOptions(TeleopJoyOptions& o, Visitor&& visit) {
  visitOptions(o.joystick, visit);
  visit("joy_timeout", o.joy_timeout,
        OptionInfo{"The vehicle is stopped this long after the joystick's last message, by the "
                   "wall clock",
                   "s", 0.01, 60.0});
  visit("command_rate", o.command_rate,
        OptionInfo{"How often the vehicle is commanded, by the wall clock", "Hz", 1.0, 1000.0});
}

// Throws InputError naming the option for a value outside its limits.
void checkTeleopJoyOptions(const TeleopJoyOptions& options);

}  // namespace grid_path_planner
