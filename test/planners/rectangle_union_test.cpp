#include "planners/rectangles/rectangle_union.h"

#include <gtest/gtest.h>

#include <random>

#include "grid_path_planner/planners/decomposition.h"
#include "support/free_cells.h"

namespace grid_path_planner::planners {

using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::BitMaps;
using grid::CellRect;
using grid::GridGeometry;

namespace {

using test::FreeCells;

std::vector<CellRect> fewest(const std::vector<CellRect>& free,
                             const std::vector<CellRect>& blocked) {
  return fewestRectangles(free, blocked, StopToken());
}

TEST(FewestRectangles, JoinsWhatIsOneRectangle) {
  EXPECT_TRUE(fewest({}, {}).empty());
  EXPECT_TRUE(fewest({{2, 3, 4, 5}}, {{0, 0, 10, 10}}).empty());
  EXPECT_EQ(fewest({{3, 1, 2, 4}, {5, 1, 6, 4}}, {}), (std::vector<CellRect>{{3, 1, 8, 4}}));
  EXPECT_EQ(fewest({{0, 0, 500, 30}}, {{499, 0, 1, 30}}), (std::vector<CellRect>{{0, 0, 499, 30}}));
}

TEST(FewestRectangles, IsLargestFirstWhereThatIsAsFew) {
  EXPECT_EQ(
      fewest({{0, 0, 500, 30}}, {{77, 12, 1, 1}}),
      (std::vector<CellRect>{{78, 0, 422, 30}, {0, 0, 77, 30}, {77, 13, 1, 17}, {77, 0, 1, 12}}));
}

// Largest first would start with a bar of the cross, and need six more rectangles.
TEST(FewestRectangles, UsesRunsWhereTheseAreFewer) {
  const std::vector<CellRect> cross = {{4, 0, 4, 12}, {0, 4, 12, 4}, {3, 3, 6, 6}};
  const std::vector<CellRect> rectangles = fewest(cross, {});
  EXPECT_EQ(rectangles.size(), 5U);
}

// Rectangles of any sizes that overlap, on a map where the same cells can be cut one by one.
TEST(FewestRectangles, IsAPartitionAndTheSmallestOfThree) {
  std::mt19937 random(29);
  const auto below = [&random](int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
  };
  for (int trial = 0; trial < 300; ++trial) {
    FreeCells cells(GridGeometry(90, 70, 1.0), 0);
    std::vector<CellRect> free, blocked;
    const auto draw = [&](std::vector<CellRect>& list, std::uint8_t value, int largest) {
      for (int left = below(9); left > 0; --left) {
        const CellRect rect =
            CellRect{below(90), below(70), 1 + below(largest), 1 + below(largest)}.intersection(
                cells.geometry().rect());
        list.push_back(rect);
        test::fillCells(cells, rect, value);
      }
    };
    draw(free, 1, 50);
    draw(blocked, 0, trial % 2 == 0 ? 10 : 2);
    const std::vector<CellRect> rectangles = fewest(free, blocked);
    ASSERT_TRUE(test::isPartition(cells, rectangles));
    const BitMaps bits = test::bitMapsOf(cells);
    EXPECT_EQ(rectangles.size(), std::min({largestFirst(bits, {}, StopToken()).size(),
                                           mergedRuns(bits.rows, StopToken()).size(),
                                           mergedRuns(bits.columns, StopToken()).size()}));
  }
}

TEST(FewestRectangles, StopsWhenAsked) {
  StopSource stop;
  stop.cancel();
  std::vector<CellRect> many;
  for (int i = 0; i < 3000; ++i) many.push_back({i, i, 2, 2});
  EXPECT_THROW(fewestRectangles(many, {}, stop.token()), Stopped);
}

}  // namespace
}  // namespace grid_path_planner::planners
