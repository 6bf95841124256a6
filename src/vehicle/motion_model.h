// How a vehicle moves in the plane when it is commanded: its velocity follows the command after a dead time, as its time
// constant and accelerations allow, and it drives on arcs.
//
//   MotionModel model(vehicle);
//   PlanarState state{position, yaw, {}};
//   state = model.advanced(state, command, 0.02);
//
// Guaranteed: what the drive cannot do is not done (a differential vehicle and a car never move sideways, a car turns on no
// narrower arc than its least one). Not in advanced(): the dead time, which is one of commands: who predicts delays them.
#pragma once

#include <Eigen/Core>

#include "grid_path_planner/base/body_velocity.h"
#include "vehicle/description.h"
#include "vehicle/motion.h"

namespace grid_path_planner::vehicle {

struct PlanarState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // m
  double yaw = 0.0;                                    // rad
  base::BodyVelocity velocity = {};                    // heave does not count
};

// Where a vehicle that keeps its velocity is so many seconds later: on an arc, or a line.
PlanarState alongArc(const PlanarState& state, double seconds);

class MotionModel {
 public:
  // Precondition: the description was checked.
  explicit MotionModel(const Description& vehicle) : vehicle_(vehicle) {}

  const Description& vehicle() const { return vehicle_; }

  // The command that the vehicle can follow: inside its limits, and without what its drive cannot do.
  base::BodyVelocity feasible(const base::BodyVelocity& command) const;
  // After so many seconds (at most 0.1: the velocity changes evenly meanwhile) of a command that is in force.
  PlanarState advanced(const PlanarState& state, const base::BodyVelocity& command,
                       double seconds) const;

 private:
  double turnedByCar(const base::BodyVelocity& velocity) const;

  Description vehicle_;
};

}  // namespace grid_path_planner::vehicle
