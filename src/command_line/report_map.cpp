#include "command_line/report_map.h"

#include <cstddef>
#include <iostream>

namespace grid_path_planner::command_line {

using grid::Occupancy, grid::OccupancyGrid, grid::OccupancyThresholds, grid::Origin;

void reportMap(const std::string& file, const OccupancyGrid& map) {
  std::size_t counts[3] = {};
  for (const std::int8_t value : map.values())
    ++counts[static_cast<int>(OccupancyThresholds().classify(value))];
  const Origin& origin = map.geometry().origin();
  std::cout << file << ": " << map.width() << "x" << map.height() << " cells of "
            << map.geometry().resolution() << " m, origin " << origin.x << ", " << origin.y
            << " m, yaw " << origin.yaw << " rad; free "
            << counts[static_cast<int>(Occupancy::FREE)] << ", unknown "
            << counts[static_cast<int>(Occupancy::UNKNOWN)] << ", occupied "
            << counts[static_cast<int>(Occupancy::OCCUPIED)] << '\n';
  if (counts[static_cast<int>(Occupancy::UNKNOWN)] == map.geometry().size())
    std::cerr << "warning: " << file << ": every cell is unknown\n";
}

}  // namespace grid_path_planner::command_line
