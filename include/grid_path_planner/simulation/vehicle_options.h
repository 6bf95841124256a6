// Limits and size of the simulated vehicle.
#pragma once

#include <string>

#include "grid_path_planner/base/options.h"

namespace grid_path_planner::simulation {

struct VehicleOptions {
  double max_surge_speed = 1.5;       // m/s
  double max_sway_speed = 1.0;        // m/s
  double max_heave_speed = 0.8;       // m/s
  double max_yaw_rate = 1.5;          // rad/s
  double max_acceleration = 1.0;      // m/s^2, of surge, sway and heave each
  double max_yaw_acceleration = 2.0;  // rad/s^2
  double least_turning_radius = 0.0;  // m
  double response_time = 0.0;         // s
  double dead_time = 0.0;             // s
  double cmd_vel_timeout = 0.5;       // s
  double vehicle_radius = 0.3;        // m
  std::string footprint = {};         // "[[x, y], ...]", m; "": the disc
  int occupied_min = 65;              // %
  double time_step = 0.01;            // s
  double roll_amplitude = 0.0;        // rad
  double roll_period = 5.0;           // s
  double pitch_amplitude = 0.0;       // rad
  double pitch_period = 7.0;          // s
};

// Groups of the options, in the order of visitOptions.
template <class Visitor>
void visitMotionOptions(VehicleOptions& o, Visitor&& visit) {
  visit("max_surge_speed", o.max_surge_speed,
        base::OptionInfo{"Fastest motion ahead and astern; faster commands are held to it", "m/s",
                         0.001, 100.0}
            .under("The vehicle"));
  visit("max_sway_speed", o.max_sway_speed,
        base::OptionInfo{
            "Fastest motion sideways; faster commands are held to it; 0: a vehicle that cannot",
            "m/s", 0.0, 100.0});
  visit("max_heave_speed", o.max_heave_speed,
        base::OptionInfo{"Fastest motion up and down; faster commands are held to it", "m/s", 0.0,
                         100.0});
  visit("max_yaw_rate", o.max_yaw_rate,
        base::OptionInfo{"Fastest turn; faster commands are held to it", "rad/s", 0.001, 100.0});
  visit(
      "max_acceleration", o.max_acceleration,
      base::OptionInfo{"How fast surge, sway and heave may change; lower: a heavier vehicle, which "
                       "overshoots more",
                       "m/s^2", 0.001, 1000.0});
  visit("max_yaw_acceleration", o.max_yaw_acceleration,
        base::OptionInfo{"How fast the yaw rate may change; lower: a heavier vehicle", "rad/s^2",
                         0.001, 1000.0});
  visit("least_turning_radius", o.least_turning_radius,
        base::OptionInfo{"Radius of the narrowest arc of a car; 0: it turns on the spot", "m", 0.0,
                         100.0});
  visit("response_time", o.response_time,
        base::OptionInfo{"Time constant with which velocities approach what is commanded, inside "
                         "the accelerations (first order); 0: at once; higher: a vehicle that "
                         "brakes later",
                         "s", 0.0, 10.0});
  visit(
      "dead_time", o.dead_time,
      base::OptionInfo{"Time from a command until the vehicle begins to follow it", "s", 0.0, 2.0});
}

template <class Visitor>
void visitBodyOptions(VehicleOptions& o, Visitor&& visit) {
  visit("cmd_vel_timeout", o.cmd_vel_timeout,
        base::OptionInfo{"The vehicle stops this long after the last command", "s", 0.01, 3600.0});
  visit("vehicle_radius", o.vehicle_radius,
        base::OptionInfo{
            "Radius of the disc, in a world the sphere, that touches obstacles: each touch "
            "counts as a contact",
            "m", 0.001, 100.0});
  visit("footprint", o.footprint,
        base::OptionInfo{"Corners of a vehicle that is not round, [[x, y], ...] in base_link, "
                         "which touch the cells of a map instead of the disc; empty: the disc",
                         "m"});
  visit(
      "occupied_min", o.occupied_min,
      base::OptionInfo{"Cells of projected_map with at least this occupancy are obstacles, unless "
                       "there is a world",
                       "%", 1, 100});
  visit(
      "time_step", o.time_step,
      base::OptionInfo{"One step of the integration; shorter: finer and slower", "s", 0.0001, 0.1});
  visit(
      "roll_amplitude", o.roll_amplitude,
      base::OptionInfo{"How far the vehicle rolls to either side, as a sine of the time; its path "
                       "stays the same; 0: it does not roll",
                       "rad", 0.0, 0.5});
  visit("roll_period", o.roll_period,
        base::OptionInfo{"Time from one roll to the same side to the next", "s", 0.5, 1000.0});
  visit("pitch_amplitude", o.pitch_amplitude,
        base::OptionInfo{"How far the vehicle pitches up and down, as a sine of the time; its path "
                         "stays the same; 0: it does not pitch",
                         "rad", 0.0, 0.5});
  visit("pitch_period", o.pitch_period,
        base::OptionInfo{"Time from one pitch up to the next", "s", 0.5, 1000.0});
}

template <class Visitor>
void visitOptions(VehicleOptions& o, Visitor&& visit) {
  visitMotionOptions(o, visit);
  visitBodyOptions(o, visit);
}

// Throws InputError naming the option for a value outside its limits and for a time_step longer
// than cmd_vel_timeout.
void checkVehicleOptions(const VehicleOptions& options);

}  // namespace grid_path_planner::simulation
