#include "ros/mapping/floor_warning.h"

#include <cstddef>
#include <cstdint>

namespace grid_path_planner::nodes {

using mapping::ProjectedMapOptions, mapping::projectionOptions, mapping::ProjectionReference;

namespace {

constexpr std::size_t kFewCells = 400;
constexpr double kLowest = -1e5;  // m: whatever is below leaves nothing out

bool leavesOutWhatIsLow(const ProjectedMapOptions& options) {
  return options.cloud.filter_ground || options.cloud.min_z > kLowest ||
         options.projection.reference == ProjectionReference::SEABED ||
         projectionOptions(options).min_z > kLowest;
}

}  // namespace

std::string floorWarning(const grid::OccupancyGrid& map, const ProjectedMapOptions& options) {
  if (leavesOutWhatIsLow(options)) return "";
  std::size_t known = 0, occupied = 0;
  for (const std::int8_t value : map.values()) {
    known += value >= 0 ? 1 : 0;
    occupied += value > 50 ? 1 : 0;
  }
  if (known < kFewCells || 2 * occupied <= known) return "";
  return "More than half of what was seen is occupied: is the floor mapped as an obstacle? Set "
         "projection_min_z above it, or filter_ground, or projection_reference seabed";
}

}  // namespace grid_path_planner::nodes
