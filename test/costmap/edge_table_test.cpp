// The original study's worked example: its program held the costs of all steps of a map as a matrix
// of (H W)^2 numbers, 59 GB for a map of 366x362 cells. Ours is implicit; here it is written out.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "support/ascii_map.h"

namespace grid_path_planner::costmap {

using base::StopToken;
using grid::Cell;
using grid::CellIndex;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

std::vector<std::vector<int>> edgeTable(const CostGrid& map) {
  const GridGeometry& geometry = map.geometry();
  std::vector<std::vector<int>> table(geometry.size(), std::vector<int>(geometry.size(), 0));
  for (std::uint32_t i = 0; i < geometry.size(); ++i)
    for (std::uint32_t j = 0; j < geometry.size(); ++j) {
      const Cell from = geometry.cell(CellIndex(i));
      const Cell to = geometry.cell(CellIndex(j));
      if (stepAllowed(map, from, to))
        table[i][j] = static_cast<int>(stepCost(map, from, to).straight);
    }
  return table;
}

TEST(EdgeTable, IsTheWorkedExample) {
  CostmapOptions options;
  options.occupied_is_passable = true;
  options.motion.diagonal_cost = DiagonalCost::UNIT;
  CostmapBuilder builder(options);
  builder.setMap(std::make_shared<OccupancyGrid>(test::AsciiMap({".?.",  //
                                                                 "#.?",  //
                                                                 "?.#"})
                                                     .map));
  const std::vector<std::vector<int>> expected = {
      {0, 50, 0, 100, 1, 0, 0, 0, 0},     {50, 0, 50, 100, 50, 50, 0, 0, 0},
      {0, 50, 0, 0, 1, 50, 0, 0, 0},      {100, 100, 0, 0, 100, 0, 100, 100, 0},
      {1, 50, 1, 100, 0, 50, 50, 1, 100}, {0, 50, 50, 0, 50, 0, 0, 50, 100},
      {0, 0, 0, 100, 50, 0, 0, 50, 0},    {0, 0, 0, 100, 1, 50, 50, 0, 100},
      {0, 0, 0, 0, 100, 100, 0, 100, 0},
  };
  EXPECT_EQ(edgeTable(*builder.downsampled(StopToken())), expected);
}

}  // namespace
}  // namespace grid_path_planner::costmap
