// The check of every motion before it is commanded: what the vehicle does by its description and the commands that were sent,
// swept over the newest map.
//
//   MotionGate gate(vehicle);
//   gate.tick(now, 1.0 / rate);                            // once a tick
//   input.motion = gate.check(pose_in_map, age, map, limits);
//   gate.sent(velocity);
//
// Belongs to one thread. Without a description nothing is checked.
#pragma once

#include <optional>

#include "grid_path_planner/following/path_clearance_check.h"
#include "grid_path_planner/following/path_follower.h"
#include "vehicle/commanded_velocity.h"

namespace grid_path_planner::nodes {

class MotionGate {
 public:
  // The description was checked; null: none.
  explicit MotionGate(const vehicle::Description* vehicle);

  bool checks() const { return commanded_.has_value(); }
  // Time in seconds, of ROS; the shortest time to the next tick.
  void tick(double now, double period);
  void sent(const base::BodyVelocity& command);

  // Precondition: checks(). `pose` was measured `age` seconds ago, in the map's frame; the map must outlive the check.
  following::MotionCheck check(const path::Pose& pose, double age, const grid::OccupancyGrid& map,
                               const following::ClearanceLimits& limits) const;

 private:
  vehicle::Description vehicle_;
  std::optional<vehicle::CommandedVelocity> commanded_;
  double now_ = 0.0;
  double period_ = 0.0;
};

}  // namespace grid_path_planner::nodes
