// What is searched of an occupancy map, made by Terrain.
#pragma once

#include <memory>

#include "grid_path_planner/terrain/terrain.h"

namespace grid_path_planner::test {

inline std::shared_ptr<const CostGrid> costsOf(const OccupancyGrid& map,
                                               const TerrainOptions& options = {}) {
  Terrain terrain(options);
  terrain.setMap(std::make_shared<const OccupancyGrid>(map));
  return terrain.searched(StopToken());
}

}  // namespace grid_path_planner::test
