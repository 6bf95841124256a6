// Whether the motion that a command begins is free: what the vehicle still follows, then the command until the next one can be
// followed, then braking to a stop, swept with its outline over a map.
//
//   const MotionCheck check(vehicle, geometry, obstacles, {state, commanded.pending(), period});
//   if (const auto contact = check.contactOf(command)) slow(command);
//
// Guaranteed: a vehicle that follows its description and drifts by no more than it says touches no cell on a motion for which
// contactOf() is none, and of such commands a zero is always one a period later. The outline grows by the drift while the
// motion goes on. A vehicle that stands nearer to obstacles than that comes no nearer: the margin, then the outline, is scaled
// down to what is free where it stands; where base_link itself is in an obstacle no motion is free. Not looked
// at: turns of a round vehicle, heights, obstacles that move.
#pragma once

#include <optional>
#include <vector>

#include "vehicle/commanded_velocity.h"
#include "vehicle/map_obstacles.h"

namespace grid_path_planner::vehicle {

// What moves, and how, when a command is chosen.
struct MovingVehicle {
  PlanarState state;                  // map frame
  std::vector<TimedCommand> pending;  // which it follows first
  double period = 0.02;               // s, until the next command
};

class MotionCheck {
 public:
  // The description was checked; `obstacles` are of a map with this geometry.
  MotionCheck(const Description& vehicle, const grid::GridGeometry& geometry,
              FootprintObstacles obstacles, MovingVehicle now);

  // Where the vehicle stands when it first touches a cell, and that cell; none where the motion is free.
  std::optional<FootprintContact> contactOf(const base::BodyVelocity& command) const;

  // The states of the motion, until it stands.
  std::vector<PlanarState> motionOf(const base::BodyVelocity& command) const;

 private:
  struct Room {
    double margin;  // m about the outline
    double
        factor;  // by which the outline is scaled where it is not free itself; 0: base_link is in an obstacle
  };

  Room roomHere() const;
  Outline outlineAfter(double seconds) const;
  std::optional<FootprintContact> sweep(const Outline& outline, const PlanarState& from,
                                        const PlanarState& to) const;
  FootprintContact standing() const;
  template <class OutlineOf>
  double largestFree(OutlineOf&& outlineOf) const;
  bool standsFree(const Outline& outline) const;

  const MotionModel model_;
  const Outline outline_;
  const grid::GridGeometry geometry_;
  const FootprintObstacles obstacles_;
  const MovingVehicle now_;
  const Room room_;
};

}  // namespace grid_path_planner::vehicle
