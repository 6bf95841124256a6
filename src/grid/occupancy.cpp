#include "grid_path_planner/grid/occupancy.h"

#include <algorithm>
#include <string>

namespace grid_path_planner {

void checkOccupancyValues(const OccupancyGrid& map) {
  const auto& values = map.values();
  const auto bad = std::find_if(values.begin(), values.end(),
                                [](std::int8_t value) { return value < -1 || value > 100; });
  if (bad == values.end()) return;
  const Cell cell =
      map.geometry().cell(CellIndex(static_cast<std::uint32_t>(bad - values.begin())));
  throw InputError("occupancy must be -1 to 100, got " + std::to_string(*bad) + " at column " +
                   std::to_string(cell.column) + ", row " + std::to_string(cell.row));
}

}  // namespace grid_path_planner
