// How fast a vehicle may be where it is, by a map of speed limits on the path ahead of it.
//
//   const double speed = allowedSpeed(limits, options, ahead);       // m/s
//
// A cell of 1 to 99 allows that many percent of max_speed; all others, and what lies outside the map, set no limit. The
// edges and corners of a cell belong to it: along the line between two slow cells the vehicle is slow.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "grid_path_planner/following/follower_options.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::following {

// Metres of the path ahead that allowedSpeed() must see: in which a vehicle at max_speed comes to a stand.
double speedLimitLookahead(const FollowerOptions& options);

// The largest speed with which the vehicle, at the first point of the polyline `ahead` (map frame, metres; the z does
// not count), slows down in time for each limited cell that the polyline meets; at most max_speed.
double allowedSpeed(const grid::OccupancyGrid& limits, const FollowerOptions& options,
                    const std::vector<Eigen::Vector3d>& ahead);

}  // namespace grid_path_planner::following
