#include "grid_path_planner/grid/occupancy.h"

#include <algorithm>
#include <string>

namespace grid_path_planner::grid {

using base::InputError;

void checkOccupancyValues(const OccupancyGrid& map) {
  checkOccupancyValues(map, map.geometry().rect());
}

void checkOccupancyValues(const OccupancyGrid& map, const CellRect& rect) {
  const CellRect inside = rect.intersection(map.geometry().rect());
  for (int row = inside.row; row < inside.row + inside.height; ++row) {
    const std::int8_t* begin = map.row(row) + inside.column;
    const std::int8_t* end = begin + inside.width;
    const auto* bad =
        std::find_if(begin, end, [](std::int8_t value) { return value < -1 || value > 100; });
    if (bad == end) continue;
    throw InputError("occupancy must be -1 to 100, got " + std::to_string(*bad) + " at column " +
                     std::to_string(bad - map.row(row)) + ", row " + std::to_string(row));
  }
}

}  // namespace grid_path_planner::grid
