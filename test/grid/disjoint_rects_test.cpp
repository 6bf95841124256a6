#include <gtest/gtest.h>

#include <random>

#include "grid_path_planner/grid/grid.h"
#include "support/random_map.h"

namespace grid_path_planner::grid {
namespace {

using Rects = std::vector<CellRect>;

// How many of the rectangles hold each cell of a map.
Grid<int> countsOf(const Rects& rects, const GridGeometry& geometry) {
  Grid<int> counts(geometry, 0);
  for (const CellRect& each : rects) {
    const CellRect rect = each.intersection(geometry.rect());
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      for (int column = rect.column; column < rect.column + rect.width; ++column)
        ++counts[Cell{column, row}];
  }
  return counts;
}

TEST(DisjointRects, OfAFewThatAreDisjointAreTheseButTheEmptyOnes) {
  EXPECT_TRUE(disjointRects({}).empty());
  EXPECT_TRUE(disjointRects({{3, 4, 0, 5}}).empty());
  EXPECT_EQ(disjointRects({{9, 9, 1, 1}, {3, 4, 0, 5}, {0, 0, 2, 2}}),
            (Rects{{9, 9, 1, 1}, {0, 0, 2, 2}}));
}

TEST(DisjointRects, ThatOverlapFarFromOthersBecomeOne) {
  EXPECT_EQ(disjointRects({{10, 10, 33, 33}, {12, 11, 33, 33}, {4000, 4000, 1, 1}}),
            (Rects{{10, 10, 35, 34}, {4000, 4000, 1, 1}}));
}

TEST(DisjointRects, OfAMapsWholeSurfaceAreTheMap) {
  Rects cells;
  for (int row = 0; row < 300; row += 3)
    for (int column = 0; column < 300; column += 3) cells.push_back({column, row, 3, 3});
  EXPECT_EQ(disjointRects(cells), (Rects{{0, 0, 300, 300}}));
}

TEST(DisjointRectsLaw, HoldEveryCellAndNoneTwice) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const GridGeometry geometry(1 + int(random() % 300), 1 + int(random() % 300), 1.0);
    Rects rects;
    for (int lists = trial % 8 == 0 ? 40 : 1; lists > 0; --lists)
      for (const CellRect& rect : test::randomRects(random, geometry, 1 << (trial % 7)))
        rects.push_back(rect);
    const int margin = trial % 3;
    Rects grown;
    for (const CellRect& rect : rects) grown.push_back(rect.grown(margin));
    const Grid<int> wanted = countsOf(grown, geometry);
    const Rects disjoint = grownRects(rects, margin, geometry.rect());
    ASSERT_LE(disjoint.size(), kMostRects);
    for (const CellRect& rect : disjoint) {
      ASSERT_FALSE(rect.empty());
      ASSERT_EQ(rect.intersection(geometry.rect()), rect);
    }
    const Grid<int> counts = countsOf(disjoint, geometry);
    for (std::uint32_t i = 0; i < geometry.size(); ++i) {
      ASSERT_LE(counts[CellIndex(i)], 1);
      ASSERT_GE(counts[CellIndex(i)], wanted[CellIndex(i)] > 0 ? 1 : 0);
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::grid
