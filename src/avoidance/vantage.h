// Where to look from at a place that cannot be seen from here: the camera sees neither its own skirts nor
// round corners.
//
// Of the places around the vehicle, in what is open, the nearest from which what is unseen about the place
// lies in the picture and behind no remembered point.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "avoidance/kept_room.h"

namespace grid_path_planner::avoidance {

std::optional<Eigen::Vector3d> vantageOf(const OpenSpace& space, const KeptRoom& room,
                                         const Eigen::Vector3d& vehicle,
                                         const Eigen::Vector3d& place, double d_safe);

}  // namespace grid_path_planner::avoidance
