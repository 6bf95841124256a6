// Zones: areas of the map that a vehicle keeps out of, or drives slowly in.
//
//   frame_id: map                    # of the points; the map's where it is left out
//   zones:
//     - {name: quay, kind: keep_out, polygon: [[1, 1], [5, 2], [3, 6]]}
//     - {name: door, kind: slow, max_speed: 0.3, polygon: [[8, 1], [9, 1], [9, 3]]}
//
// Points are x and y in metres, max_speed in m/s. A zone holds each cell that its polygon touches
// (grid/polygon_cover.h); of a polygon that crosses itself, what a ray leaves after an odd number of edges.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "grid_path_planner/base/read_limits.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::layers {

struct Zone {
  enum class Kind { KEEP_OUT, SLOW };

  std::string name;  // where there is none, its number in the file from 1
  Kind kind = Kind::KEEP_OUT;
  double max_speed = 0.0;  // m/s, of a slow one
  std::vector<Eigen::Vector2d> polygon;
};

struct Zones {
  std::string frame_id;  // empty where the file names none
  std::vector<Zone> zones;
};

// Throws InputError naming file and line for what is no file of zones: a key that is not known, another kind, fewer
// than three points, a point beyond 1e6 m, more than 10,000 points, a speed that is not above 0, one of a zone that is not slow.
Zones readZones(const std::string& file, const base::ReadLimits& limits = {});

// 100 in the cells of `map` that the keep-out zones touch. Returns the names of zones, of either kind, that lie
// outside of the map.
std::vector<std::string> drawKeepOutZones(const Zones& zones, grid::OccupancyGrid& map);

}  // namespace grid_path_planner::layers
