// What a vehicle is: how it is driven, its outline, its limits. One description serves the driver, its checks and the
// simulator; config/vehicles has ready ones, doc/vehicle.md says what each value means.
//
//   Description vehicle = readDescription("config/vehicles/jackal.yaml");  // throws InputError
//   const Outline outline = outlineOf(vehicle);
//
// A description has no default outline, drive and limits: what must be given and is not is refused.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "grid_path_planner/base/options.h"
#include "vehicle/outline.h"

namespace grid_path_planner::vehicle {

// OMNIDIRECTIONAL goes sideways, too; DIFFERENTIAL goes ahead and turns, also on the spot; CAR turns on arcs only.
enum class Drive { NOT_GIVEN, OMNIDIRECTIONAL, DIFFERENTIAL, CAR };
const std::vector<std::pair<const char*, Drive>>& choicesOf(Drive);

struct Description {
  Drive drive = Drive::NOT_GIVEN;
  double radius = 0.0;                // m
  std::string outline;                // "[[x, y], ...]", m
  double base_height = 0.0;           // m
  double max_speed = 0.0;             // m/s
  double max_backward_speed = 0.0;    // m/s
  double max_sideways_speed = 0.0;    // m/s
  double max_vertical_speed = 0.0;    // m/s
  double max_yaw_rate = 0.0;          // rad/s
  double max_acceleration = 0.0;      // m/s^2
  double max_yaw_acceleration = 0.0;  // rad/s^2
  double least_turning_radius = 0.0;  // m
  double dead_time = 0.1;             // s
  double time_constant = 0.1;         // s
  double drift = 0.0;                 // m/s
  double hold_distance = 0.5;         // m
  double hold_time = 60.0;            // s

  bool changesHeight() const { return max_vertical_speed > 0.0; }
};

// Groups of the options, in the order of visitOptions.
template <class Visitor>
void visitShapeOptions(Description& o, Visitor&& visit) {
  visit("drive", o.drive,
        base::OptionInfo{
            "How it moves: omnidirectional goes sideways too, differential has two driven wheels "
            "and turns on the spot, car steers and turns on arcs only; must be given",
            ""}
            .under("Drive and outline"));
  visit("radius", o.radius,
        base::OptionInfo{"Radius of a round outline about base_link; this or outline must be given",
                         "m", 0.0, 100.0});
  visit("outline", o.outline,
        base::OptionInfo{"Corners of an outline that is not round, [[x, y], ...] in base_link, "
                         "convex and anticlockwise",
                         "m"});
  visit("base_height", o.base_height,
        base::OptionInfo{"Height of base_link above the plane of the map, for vehicles that cannot "
                         "change it",
                         "m", -10.0, 100.0});
}

template <class Visitor>
void visitLimitOptions(Description& o, Visitor&& visit) {
  visit("max_speed", o.max_speed,
        base::OptionInfo{"Largest speed ahead; must be given", "m/s", 0.01, 100.0}.under("Limits"));
  visit(
      "max_backward_speed", o.max_backward_speed,
      base::OptionInfo{"Largest speed backwards; 0: it never drives backwards", "m/s", 0.0, 100.0});
  visit("max_sideways_speed", o.max_sideways_speed,
        base::OptionInfo{"Largest speed sideways, of omnidirectional ones", "m/s", 0.0, 100.0});
  visit("max_vertical_speed", o.max_vertical_speed,
        base::OptionInfo{"Largest speed up and down; 0: it stays on its plane, and heights do not "
                         "count for its arrival",
                         "m/s", 0.0, 100.0});
  visit("max_yaw_rate", o.max_yaw_rate,
        base::OptionInfo{"Fastest turn; must be given", "rad/s", 0.01, 100.0});
  visit("max_acceleration", o.max_acceleration,
        base::OptionInfo{"Change of speed, braking included; must be given", "m/s^2", 0.01, 100.0});
  visit("max_yaw_acceleration", o.max_yaw_acceleration,
        base::OptionInfo{"Change of the yaw rate; must be given", "rad/s^2", 0.01, 100.0});
  visit("least_turning_radius", o.least_turning_radius,
        base::OptionInfo{"Radius of the narrowest arc of a car, which must give it", "m", 0.0,
                         100.0});
}

template <class Visitor>
void visitResponseOptions(Description& o, Visitor&& visit) {
  visit("dead_time", o.dead_time,
        base::OptionInfo{"Time from a command until the vehicle begins to follow it; higher: the "
                         "motion check brakes earlier",
                         "s", 0.0, 2.0}
            .under("Response"));
  visit("time_constant", o.time_constant,
        base::OptionInfo{"Time constant with which its velocity approaches the command", "s", 0.0,
                         5.0});
  visit("drift", o.drift,
        base::OptionInfo{"Largest velocity that nobody commands while it drives, by slip or "
                         "currents; higher: the motion check keeps farther off",
                         "m/s", 0.0, 5.0});
  visit("hold_distance", o.hold_distance,
        base::OptionInfo{"How far a pose that is held after the arrival is returned to; farther "
                         "off the vehicle stands",
                         "m", 0.0, 100.0}
            .under("After the arrival"));
  visit(
      "hold_time", o.hold_time,
      base::OptionInfo{"How long a pose is held after the arrival; 0: not at all", "s", 0.0, 1e6});
}

template <class Visitor>
void visitOptions(Description& o, Visitor&& visit) {
  visitShapeOptions(o, visit);
  visitLimitOptions(o, visit);
  visitResponseOptions(o, visit);
}

// Throws InputError, which begins with `name`, for values outside their limits, what is missing, a radius and an outline
// that disagree, an outline that is concave or clockwise, and what contradicts the drive.
void checkDescription(const std::string& name, const Description& vehicle);

// Of a YAML file with one mapping, `vehicle`. Throws InputError that names file and line, or as checkDescription does.
Description readDescription(const std::string& file);

// Precondition: the description was checked.
Outline outlineOf(const Description& vehicle);

// What is set and what the vehicle's description says has to be the same; a value of `unset`, the default, is taken to be not
// set. Throws InputError naming the option.
void unite(const char* name, double& value, double unset, double described);
// The same of corners, "": not set.
void uniteOutline(const char* name, std::string& corners, const Description& vehicle);
// Throws InputError naming the option for a distance to keep, above 0, that is less than the outline's inscribed radius.
void checkKeptDistance(const char* name, double distance, const Description& vehicle);

}  // namespace grid_path_planner::vehicle
