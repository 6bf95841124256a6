// Whether a vehicle that is not round keeps off obstacles on the path ahead.
//
//   if (const auto found = firstFootprintContact(map, limits, footprint, ahead)) halt(found->at);
#pragma once

#include <optional>
#include <vector>

#include "grid_path_planner/following/path_clearance_check.h"
#include "vehicle/footprint.h"

namespace grid_path_planner::following {

// The first cell that the footprint meets on the polyline `ahead` (map frame, metres; the z does not count) from its second point
// on, looking along it and turning on the spot at its corners: an occupied one, with stop_at_unknown an unknown one or the
// outside of the map. The first segment is the vehicle's return to its path, which firstObstruction() judges. Nothing where
// that polyline goes nowhere, as at the end of a path: a turn there, and the first one, are not looked at. Precondition: the
// footprint is not empty.
std::optional<Obstruction> firstFootprintContact(const grid::OccupancyGrid& map,
                                                 const ClearanceLimits& limits,
                                                 const vehicle::Footprint& footprint,
                                                 const std::vector<Eigen::Vector3d>& ahead);

}  // namespace grid_path_planner::following
