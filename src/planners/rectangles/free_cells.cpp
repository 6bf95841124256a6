#include "grid_path_planner/planners/free_cells.h"

#include <algorithm>

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::BitMaps;
using grid::Grid, grid::Occupancy, grid::OccupancyGrid, grid::OccupancyThresholds;

BitMaps freeCellsOf(const OccupancyGrid& map, const OccupancyThresholds& thresholds,
                    bool unknown_is_free, const StopToken& stop) {
  Grid<std::uint16_t> weights(map.geometry());
  std::transform(map.values().begin(), map.values().end(), weights.values().begin(),
                 [&](std::int8_t value) -> std::uint16_t {
                   const Occupancy occupancy = thresholds.classify(value);
                   return occupancy == Occupancy::FREE ||
                                  (unknown_is_free && occupancy == Occupancy::UNKNOWN)
                              ? 1
                              : 0;
                 });
  return BitMaps(weights, stop);
}

}  // namespace grid_path_planner::planners
