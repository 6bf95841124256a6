#include "ros/planning/record/map_checksum.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "support/random_map.h"

namespace grid_path_planner::nodes {

using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

TEST(MapChecksum, FollowsChangesAsIfMadeAnew) {
  std::mt19937 random(17);
  for (int trial = 0; trial < 50; ++trial) {
    OccupancyGrid map = test::randomOccupancy(random, 40, 0.2, 0.2);
    MapChecksum checksum(map);
    for (const CellRect& changed : test::randomRects(random, map.geometry(), 9)) {
      const CellRect rect = changed.intersection(map.geometry().rect());
      checksum.change(map, rect, [&] {
        for (int row = rect.row; row < rect.row + rect.height; ++row)
          for (int column = rect.column; column < rect.column + rect.width; ++column)
            map[Cell{column, row}] = static_cast<std::int8_t>(random() % 102) - 1;
      });
      EXPECT_EQ(checksum.value(), MapChecksum(map).value());
    }
  }
}

TEST(MapChecksum, EveryCellValueAndPlaceCounts) {
  std::set<std::uint64_t> seen;
  OccupancyGrid map(GridGeometry(13, 9, 0.05));
  std::size_t maps = 0;
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 13; ++column)
      for (const int value : {-1, 50, 100}) {
        map[Cell{column, row}] = static_cast<std::int8_t>(value);
        seen.insert(MapChecksum(map).value());
        map[Cell{column, row}] = 0;
        ++maps;
      }
  for (const GridGeometry& geometry :
       {GridGeometry(9, 13, 0.05), GridGeometry(13, 9, 0.1), GridGeometry(13, 9, 0.05, {1, 0, 0}),
        GridGeometry(13, 9, 0.05, {0, 1, 0}), GridGeometry(13, 9, 0.05, {0, 0, 1})}) {
    seen.insert(MapChecksum(OccupancyGrid(geometry, 0)).value());
    ++maps;
  }
  EXPECT_EQ(seen.size(), maps);
}

}  // namespace
}  // namespace grid_path_planner::nodes
