// Whether the path ahead of a vehicle is free in a map, and its return to the path.
//
//   if (const auto found = firstObstruction(map, {{25, 65}, 0.35, true}, ahead)) halt(found->at);
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::following {

// The first cell along the polyline `ahead` (map frame, metres; the z does not count) of at least
// `occupied_min` that the polyline meets, or comes nearer to than `radius` metres; none where all
// is free. "First" by pieces of the polyline of at most ten cells. Grazing a cell's edge or corner
// meets nothing; unknown cells and what lies outside the map are free.
std::optional<grid::Cell> firstOccupied(const grid::OccupancyGrid& map, int occupied_min,
                                        const std::vector<Eigen::Vector3d>& ahead, double radius);

struct ClearanceLimits {
  grid::OccupancyThresholds thresholds = {};
  double radius = 0.0;           // m, to occupied cells
  bool stop_at_unknown = false;  // whether unknown cells and the outside of the map obstruct too
};

struct Obstruction {
  enum class Kind { OCCUPIED, UNKNOWN, OUTSIDE };
  Kind kind;
  Eigen::Vector2d at;  // map frame, metres
};

// What obstructs the polyline `ahead`, which begins at the vehicle and leads by its second point
// back to the path; none where it is free. The return may be as near to occupied cells as the
// vehicle itself is, and no nearer: a vehicle that was pushed into the radius comes out of it.
// Unknown cells and the outside obstruct where the polyline meets them, without a radius.
std::optional<Obstruction> firstObstruction(const grid::OccupancyGrid& map,
                                            const ClearanceLimits& limits,
                                            const std::vector<Eigen::Vector3d>& ahead);

}  // namespace grid_path_planner::following
