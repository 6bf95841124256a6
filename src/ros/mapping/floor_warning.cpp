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

bool showsTheFloor(const grid::OccupancyGrid& map, const ProjectedMapOptions& options) {
  if (leavesOutWhatIsLow(options)) return false;
  std::size_t known = 0, occupied = 0;
  for (const std::int8_t value : map.values()) {
    known += value >= 0 ? 1 : 0;
    occupied += value > 50 ? 1 : 0;
  }
  return known >= kFewCells && 2 * occupied > known;
}

}  // namespace grid_path_planner::nodes
