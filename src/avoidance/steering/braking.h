// Whether a command leaves the vehicle time to stop in the open: the law that makes flying safe.
//
//   if (stopsInOpen(motion, velocity, yaw_rate, room, moving, options)) vehicle.command(velocity, yaw_rate);
//
// The motion is computed that follows where the command holds for frame_period (at least a tick of the
// computation, 0.05 s) and zero is commanded then: the vehicle goes on for response_time with the velocity
// that it has, changes it towards the command for frame_period, keeps it for response_time, and brakes. Each
// axis of the body changes by max_acceleration. Its velocity turns with its body until it brakes, by the
// measured yaw rate first, then by the commanded one. Every point of that must be open. Things that move are
// kept as far away as they come meanwhile at 1 m/s, while the vehicle moves.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "avoidance/steering/kept_room.h"
#include "grid_path_planner/avoidance/pilot_options.h"

namespace grid_path_planner::avoidance {

// In the map frame; m, m/s, rad, rad/s.
struct Motion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double yaw = 0.0;
  double yaw_rate = 0.0;
};

bool stopsInOpen(const Motion& motion, const Eigen::Vector3d& command, double yaw_rate,
                 const KeptRoom& room, const std::vector<Eigen::Vector3f>& moving,
                 const PilotOptions& options);

// The largest speed v with v tau + v^2 / (2 a) <= metres, tau = frame_period + response_time.
double speedWithin(double metres, const PilotOptions& options);

}  // namespace grid_path_planner::avoidance
