// A pilot in a process of its own, which is told what the vehicle sees and answers a velocity; the protocol
// is in doc/flights.md. So that other planners fly the same flights, in any language.
#pragma once

#include <string>

#include "flights/flight_pilot.h"
#include "flights/program_process.h"

namespace grid_path_planner::flights {

// What a program answered. Throws InputError for a line of another form.
avoidance::PilotAnswer pilotAnswerFrom(const std::string& line);

class ProgramPilot : public FlightPilot {
 public:
  // Starts the program. Throws InputError where that fails.
  ProgramPilot(const FlightStudy& study, const FlightVariant& variant,
               const simulation::CameraIntrinsics& camera);

  // Throws InputError where the program has ended, answers something else or nothing for a minute.
  avoidance::PilotAnswer update(const avoidance::PilotInput& input) override;
  std::string explain() const override { return ""; }

 private:
  std::string name_;
  ProgramProcess process_;
};

}  // namespace grid_path_planner::flights
