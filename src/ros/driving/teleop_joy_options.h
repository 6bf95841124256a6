// The parameters of the node `teleop_joy`.
#pragma once

#include "grid_path_planner/following/joystick.h"
#include "ros/guard/scheduling/realtime_priority.h"

namespace grid_path_planner::nodes {

struct TeleopJoyOptions {
  following::JoystickOptions joystick;
  double joy_timeout = 0.5;    // s, wall time
  double command_rate = 20.0;  // Hz, wall time
  int realtime_priority = 1;
};

template <class Visitor>
void visitOptions(TeleopJoyOptions& o, Visitor&& visit) {
  visitOptions(o.joystick, visit);
  visit("joy_timeout", o.joy_timeout,
        base::OptionInfo{"The vehicle is stopped when the joystick has been silent for so long",
                         "s", 0.01, 60.0}
            .under("Time, by the wall clock"));
  visit("command_rate", o.command_rate,
        base::OptionInfo{
            "How often the vehicle is commanded; simulated time that runs faster needs more", "Hz",
            1.0, 1000.0});
  visitRealtimePriority(o.realtime_priority, visit);
}

// Throws InputError naming the option for a value outside its limits.
void checkTeleopJoyOptions(const TeleopJoyOptions& options);

}  // namespace grid_path_planner::nodes
