// One flight in lock-step: the simulated vehicle and the pilot take turns, no clock is asked.
//
//   const FlightSetup setup(study, 0);              // world 0 is read
//   const FlightRecord record = fly(setup, variant, seed, "");
//
// Guaranteed: the same study, variant and seed give the same flight, bit for bit, whatever was flown
// before and wherever; the pilot is given odometry and frames and never the truth, and length, contacts and
// clearance are the truth's.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "flights/flight_record.h"
#include "flights/flight_study.h"
#include "grid_path_planner/avoidance/pilot.h"
#include "grid_path_planner/simulation/depth_camera.h"
#include "grid_path_planner/simulation/world.h"

namespace grid_path_planner::flights {

class FlightSetup {
 public:
  // Throws InputError for a world that cannot be read. `study` outlives it.
  FlightSetup(const FlightStudy& study, std::size_t world);

  const FlightStudy& study() const { return study_; }
  std::size_t worldNumber() const { return number_; }
  const std::shared_ptr<const simulation::World>& world() const { return world_; }
  const std::shared_ptr<const simulation::MovingBodies>& bodies() const { return bodies_; }
  const simulation::DepthCamera& camera() const { return camera_; }

 private:
  const FlightStudy& study_;
  std::size_t number_;
  std::shared_ptr<const simulation::World> world_;
  std::shared_ptr<const simulation::MovingBodies> bodies_;
  simulation::DepthCamera camera_;
};

// Told of every update.
using FlightWatch =
    std::function<void(const avoidance::PilotInput& input, const avoidance::PilotAnswer& answer)>;

// `log`: a file for the pilot's log, "" for none.
FlightRecord fly(const FlightSetup& setup, std::size_t variant, int seed,
                 const std::string& log = "", const FlightWatch& watch = {});

}  // namespace grid_path_planner::flights
