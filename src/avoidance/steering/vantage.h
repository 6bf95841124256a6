// Where to look from at a place that cannot be seen from here: the camera sees neither its own skirts nor
// round corners.
//
// Where a turn shows more, that is here. Else, of the places around the vehicle, in what is open, the nearest
// from which what is unseen about the place lies in the picture and behind no remembered point.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "avoidance/steering/kept_room.h"

namespace grid_path_planner::avoidance {

// What is unseen about the place, to be seen from the vehicle, but not in a picture that is taken at `yaw`.
std::vector<Eigen::Vector3d> unseenAside(const OpenSpace& space, const Eigen::Vector3d& vehicle,
                                         double yaw, const Eigen::Vector3d& place, double d_safe);

// The path there, which begins at the vehicle: straight, or back along `track`, where the vehicle was, the
// newest last. Empty where no place shows more than here.
std::vector<Eigen::Vector3d> pathToVantage(const OpenSpace& space, const KeptRoom& room,
                                           const Eigen::Vector3d& vehicle,
                                           const Eigen::Vector3d& place, double d_safe,
                                           const std::vector<Eigen::Vector3d>& track);

}  // namespace grid_path_planner::avoidance
