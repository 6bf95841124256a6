// What flies in a study: the package's pilot, or a program that talks over pipes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "flights/flight_study.h"
#include "grid_path_planner/avoidance/pilot.h"
#include "grid_path_planner/simulation/depth_camera.h"

namespace grid_path_planner::flights {

class FlightPilot {
 public:
  virtual ~FlightPilot() = default;
  // Throws InputError where the pilot itself fails; the flight ends then.
  virtual avoidance::PilotAnswer update(const avoidance::PilotInput& input) = 0;
  // More about a status that ended the flight.
  virtual std::string explain() const = 0;
};

// `log`: a file for the pilot's log, from which its answers are repeated; "" for none. Throws InputError
// for a program that cannot be started and a log that cannot be written.
std::unique_ptr<FlightPilot> makeFlightPilot(const FlightStudy& study, const FlightVariant& variant,
                                             const simulation::CameraIntrinsics& camera,
                                             const std::string& log);

}  // namespace grid_path_planner::flights
