#include "flights/flight_steps.h"

#include <cmath>

#include "grid_path_planner/base/decimal_text.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::flights {

using base::decimalText, base::InputError;

namespace {

int stepsOf(double period, double step, const char* what) {
  const double steps = period / step;
  if (std::abs(steps - std::round(steps)) > 1e-6 || steps < 0.5)
    throw InputError(std::string("the period of ") + what + " must be whole steps of the vehicle");
  return static_cast<int>(std::lround(steps));
}

}  // namespace

FlightSteps flightSteps(const FlightStudy& study) {
  const double step = study.vehicle.time_step;
  const FlightSteps steps = {stepsOf(1.0 / study.command_rate, step, "commands"),
                             stepsOf(1.0 / study.camera.rate, step, "frames")};
  if (steps.frame % steps.command != 0)
    throw InputError("command_rate, " + decimalText(study.command_rate) +
                     " Hz, must be a multiple of camera_rate, " + decimalText(study.camera.rate) +
                     " Hz: frames are taken with commands");
  return steps;
}

}  // namespace grid_path_planner::flights
