// What the numbers of a nav_msgs/OccupancyGrid mean: -1 unknown, 0..25 free, 65..100 occupied,
// inclusive, anything between unknown. Both thresholds are settable; other values are bad input.
#pragma once

#include <cstdint>

#include "grid_path_planner/grid/grid.h"

namespace grid_path_planner::grid {

enum class Occupancy : std::uint8_t { FREE, UNKNOWN, OCCUPIED };

using OccupancyGrid = Grid<std::int8_t>;

struct OccupancyThresholds {
  int free_max = 25;      // percent
  int occupied_min = 65;  // percent

  Occupancy classify(std::int8_t value) const {
    if (value >= occupied_min) return Occupancy::OCCUPIED;
    return value >= 0 && value <= free_max ? Occupancy::FREE : Occupancy::UNKNOWN;
  }
};

// Throws InputError naming the first cell (of `rect`) whose value is not in -1..100.
void checkOccupancyValues(const OccupancyGrid& map);
void checkOccupancyValues(const OccupancyGrid& map, const CellRect& rect);

}  // namespace grid_path_planner::grid
