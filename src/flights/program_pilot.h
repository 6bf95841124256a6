// A pilot in a process of its own, which is told what the vehicle sees and answers a velocity; the protocol
// is in doc/flights.md. So that other planners fly the same flights, in any language.
#pragma once

#include <sys/types.h>

#include <string>

#include "flights/flight_pilot.h"

namespace grid_path_planner::flights {

class ProgramPilot : public FlightPilot {
 public:
  // Starts the program. Throws InputError where that fails.
  ProgramPilot(const FlightStudy& study, const FlightVariant& variant,
               const simulation::CameraIntrinsics& camera);
  ~ProgramPilot() override;  // ends the program
  ProgramPilot(const ProgramPilot&) = delete;
  ProgramPilot& operator=(const ProgramPilot&) = delete;

  // Throws InputError where the program has ended, answers something else or nothing for a minute.
  avoidance::PilotAnswer update(const avoidance::PilotInput& input) override;
  std::string explain() const override { return ""; }

 private:
  void start(const std::vector<std::string>& program);
  void send(const void* data, std::size_t size);
  std::string receiveLine();

  std::string name_;
  pid_t process_ = 0;
  int to_ = -1;
  int from_ = -1;
  std::string received_;
};

}  // namespace grid_path_planner::flights
