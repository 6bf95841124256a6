// A map of free and blocked cells that changes, as planners are told of it.
#pragma once

#include <memory>

#include "grid_path_planner/terrain/cost_grid.h"
#include "support/rectangle_survey.h"

namespace grid_path_planner::test {

// Free cells weigh 1. `revision`: one more than that of the map before it.
inline std::shared_ptr<const CostGrid> costsOf(const FreeCells& free, std::uint64_t revision = 0) {
  Grid<CostGrid::Weight> weights(free.geometry());
  for (std::size_t i = 0; i < free.values().size(); ++i)
    weights.values()[i] = free.values()[i] != 0 ? 1 : CostGrid::kBlocked;
  auto map = std::make_shared<CostGrid>(
      std::move(weights), Grid<Occupancy>(free.geometry(), Occupancy::FREE), MotionModel());
  map->setRevision(revision);
  return map;
}

}  // namespace grid_path_planner::test
