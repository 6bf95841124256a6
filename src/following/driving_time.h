// How long the rest of a route takes, by the limits of speed of the options.
//
// Guaranteed: no less than the length at max_speed; work in proportion to the knots, whatever the length. Not guaranteed:
// what obstacles, a joystick or a current add. The vehicle is taken to drive already: from rest it needs about
// max_speed / (2 max_acceleration) more.
#pragma once

#include "following/driven_route.h"

namespace grid_path_planner::following {

// Seconds from `share` of segment `segment` to the knot `end`, at which the vehicle stops facing as the knot says.
double drivingTime(const DrivenRoute& route, std::size_t segment, double share, std::size_t end,
                   const FollowerOptions& options);

}  // namespace grid_path_planner::following
