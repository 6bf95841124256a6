// What is searched of an occupancy map, made by Terrain.
#pragma once

#include <memory>

#include "grid_path_planner/costmap/costmap_builder.h"

namespace grid_path_planner::test {

inline std::shared_ptr<const costmap::CostGrid> costsOf(
    const grid::OccupancyGrid& map, const costmap::CostmapOptions& options = {}) {
  costmap::CostmapBuilder terrain(options);
  terrain.setMap(std::make_shared<const grid::OccupancyGrid>(map));
  return terrain.downsampled(base::StopToken());
}

}  // namespace grid_path_planner::test
