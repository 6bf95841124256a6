// Cost grids from pictures, from weights and from occupancy maps.
//
//   CostGrid map = costMap({"1.#",
//                           "?9."});
//   auto shared = costsOf(AsciiMap({"S.#", "..G"}).map, options);
//
// Letters of a picture: '1' to '9' is the weight of a free cell, '.' is free and weighs 1, '?' is
// unknown and weighs 50, '#' is occupied and blocked. The first line is row 0.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/costmap/cost_grid.h"
#include "grid_path_planner/costmap/costmap_options.h"
#include "support/rectangle_survey.h"

namespace grid_path_planner::test {

using Weights = grid::Grid<costmap::CostGrid::Weight>;

// Throws std::invalid_argument for lines of different lengths and other letters.
costmap::CostGrid costMap(const std::vector<std::string>& lines);

// All cells are of class FREE.
costmap::CostGrid costMap(Weights weights, const costmap::MotionModel& motion = {});

// The same as planners take them. `revision`: one more than that of the map before it.
std::shared_ptr<const costmap::CostGrid> costsOf(const std::vector<std::string>& lines);
std::shared_ptr<const costmap::CostGrid> costsOf(Weights weights,
                                                 const costmap::MotionModel& motion = {},
                                                 std::uint64_t revision = 0);
// Free cells weigh 1.
std::shared_ptr<const costmap::CostGrid> costsOf(const FreeCells& free, std::uint64_t revision = 0);

// What CostmapBuilder makes of a map, with the kernel of the options.
std::shared_ptr<const costmap::CostGrid> costsOf(const grid::OccupancyGrid& map,
                                                 const costmap::CostmapOptions& options = {});

// All cells, row by row.
std::vector<grid::Cell> cellsOf(const costmap::CostGrid& map);

}  // namespace grid_path_planner::test
