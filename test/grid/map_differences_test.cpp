#include "grid/map_differences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/ascii_map.h"
#include "support/random_map.h"

namespace grid_path_planner::grid {
namespace {

using Rects = std::vector<CellRect>;

TEST(Differences, AreTheSmallestRectangleAroundOnesNearby) {
  const OccupancyGrid before = test::AsciiMap({"....", "....", "...."}).map;
  EXPECT_TRUE(differences(before, before.values()).empty());
  const OccupancyGrid after = test::AsciiMap({"....", "..#.", ".#.."}).map;
  EXPECT_EQ(differences(before, after.values()), (Rects{{1, 1, 2, 2}}));
}

TEST(Differences, OfOppositeCornersAreTwoCells) {
  const OccupancyGrid before(GridGeometry(1000, 700, 1.0), 0);
  OccupancyGrid after = before;
  after[Cell{0, 0}] = after[Cell{999, 699}] = 100;
  EXPECT_EQ(differences(before, after.values()), (Rects{{0, 0, 1, 1}, {999, 699, 1, 1}}));
}

TEST(DifferencesLaw, NothingOutsideDiffers) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const GridGeometry geometry(1 + int(random() % 400), 1 + int(random() % 400), 1.0);
    const OccupancyGrid before(geometry, 0);
    OccupancyGrid after = before;
    const int count = trial % 3 == 0 ? trial * 10 : trial % 5;
    for (int i = 0; i < count; ++i) after[test::randomCell(random, geometry)] = 100;
    OccupancyGrid covered = before;
    const Rects changed = differences(before, after.values());
    ASSERT_LE(changed.size(), kMostRects);
    for (const CellRect& rect : changed) {
      ASSERT_EQ(rect.intersection(geometry.rect()), rect);
      for (int row = rect.row; row < rect.row + rect.height; ++row)
        std::fill_n(covered.row(row) + rect.column, rect.width, std::int8_t{100});
    }
    for (std::uint32_t i = 0; i < geometry.size(); ++i)
      ASSERT_LE(after[CellIndex(i)], covered[CellIndex(i)]);
  }
}

}  // namespace
}  // namespace grid_path_planner::grid
