// A map of free and blocked cells that changes, as planners are told of it.
#pragma once

#include <memory>

#include "grid_path_planner/costmap/cost_grid.h"
#include "support/rectangle_survey.h"

namespace grid_path_planner::test {

// Free cells weigh 1. `revision`: one more than that of the map before it.
inline std::shared_ptr<const costmap::CostGrid> costsOf(const FreeCells& free,
                                                        std::uint64_t revision = 0) {
  grid::Grid<costmap::CostGrid::Weight> weights(free.geometry());
  for (std::size_t i = 0; i < free.values().size(); ++i)
    weights.values()[i] = free.values()[i] != 0 ? 1 : costmap::CostGrid::kBlocked;
  auto map = std::make_shared<costmap::CostGrid>(
      std::move(weights), grid::Grid<grid::Occupancy>(free.geometry(), grid::Occupancy::FREE),
      costmap::MotionModel());
  map->setRevision(revision);
  return map;
}

}  // namespace grid_path_planner::test
