// In how many steps of the simulated vehicle commands and frames come.
//
// Guaranteed: each frame comes with a command, so that frames are as many as `camera_rate` says.
#pragma once

#include "flights/flight_study.h"

namespace grid_path_planner::flights {

struct FlightSteps {
  int command = 1;  // between two commands
  int frame = 1;    // between two frames, a multiple of that
};

// Throws InputError where a period is no whole number of the vehicle's steps, and where that of frames is none of
// the commands'.
FlightSteps flightSteps(const FlightStudy& study);

}  // namespace grid_path_planner::flights
