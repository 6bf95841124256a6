// A pilot, and what it is given and answers in a flight log, where one is wanted.
//
//   LoggedPilot pilot(options);
//   pilot.logTo(file, 4000);                  // MB; `grid_path flights --log FILE` repeats it
//   const PilotAnswer answer = pilot.update(input);
//   if (const auto problem = pilot.takeLogProblem()) ROS_WARN_STREAM(*problem);
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/avoidance/flight_log.h"
#include "grid_path_planner/avoidance/pilot.h"

namespace grid_path_planner::nodes {

class LoggedPilot {
 public:
  explicit LoggedPilot(const avoidance::PilotOptions& options) : pilot_(options) {}

  // Throws InputError where it cannot be written. `megabytes` is the most that is.
  void logTo(const base::OutputFile& file, int megabytes);

  // As the pilot's.
  void setOptions(const avoidance::PilotOptions& options);
  void setRoute(const std::vector<Eigen::Vector3d>& points);
  void setPath(const std::vector<Eigen::Vector3d>& points);
  void setMapPlan(const avoidance::MapPlan& plan);
  void cancel(const std::string& reason);
  void see(const avoidance::Frame& frame);
  avoidance::PilotAnswer update(const avoidance::PilotInput& input);

  const avoidance::Pilot& pilot() const { return pilot_; }
  // Once, when the log has ended before the flight.
  std::optional<std::string> takeLogProblem();

 private:
  avoidance::Pilot pilot_;
  std::optional<avoidance::FlightLog> log_;
  bool told_ = false;
};

}  // namespace grid_path_planner::nodes
