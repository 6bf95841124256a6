#include "following/footprint_clearance.h"

#include "path/motions.h"
#include "vehicle/map_obstacles.h"

namespace grid_path_planner::following {

using base::StopToken;
using grid::OccupancyGrid;
using path::HeadingMode;
using path::motionsAlong;
using path::Path;
using vehicle::Footprint;
using vehicle::FootprintSweep;
using vehicle::mapObstacles;
using vehicle::Motion;

namespace {

constexpr double kSamePlace = 1e-6;  // m

Obstruction obstructionAt(const OccupancyGrid& map, const ClearanceLimits& limits,
                          grid::Cell cell) {
  const Eigen::Vector2d at = map.geometry().centre(cell);
  if (!map.contains(cell)) return {Obstruction::Kind::OUTSIDE, at};
  const bool occupied = map[cell] >= limits.thresholds.occupied_min;
  return {occupied ? Obstruction::Kind::OCCUPIED : Obstruction::Kind::UNKNOWN, at};
}

// From the second point on, without those that are where the one before is: rounding has no direction.
Path withDirections(const std::vector<Eigen::Vector3d>& ahead) {
  Path path;
  for (std::size_t i = 1; i < ahead.size(); ++i)
    if (path.empty() || (ahead[i] - path.poses.back().position).head<2>().norm() > kSamePlace)
      path.poses.push_back({ahead[i], 0.0});
  return path;
}

}  // namespace

std::optional<Obstruction> firstFootprintContact(const OccupancyGrid& map,
                                                 const ClearanceLimits& limits,
                                                 const Footprint& footprint,
                                                 const std::vector<Eigen::Vector3d>& ahead) {
  const Path path = withDirections(ahead);
  if (path.poses.size() < 2) return std::nullopt;
  const FootprintSweep sweep(footprint, map.geometry(),
                             mapObstacles(map, limits.thresholds, limits.stop_at_unknown));
  for (const Motion& motion : motionsAlong(path, std::nullopt, std::nullopt, HeadingMode::NONE))
    if (const auto contact = sweep.first(motion, StopToken()))
      return obstructionAt(map, limits, contact->cell);
  return std::nullopt;
}

}  // namespace grid_path_planner::following
