#include "grid_path_planner/planners/rectangle_graph.h"

#include <gtest/gtest.h>

#include <random>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/planners/decomposition.h"
#include "planners/rectangles/rectangle_index.h"
#include "support/error_text.h"
#include "support/free_cells.h"

namespace grid_path_planner::planners {

using base::Stopped;
using base::StopSource;
using base::StopToken;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;

namespace {

using test::bitMapsOf;
using test::FreeCells;

TEST(RectangleGraph, KnowsWhichRectangleHoldsACell) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 100; ++trial) {
    const FreeCells free = test::randomBlocks(random, 50);
    const RectangleGraph map(free.geometry(), largestFirst(bitMapsOf(free), {}, StopToken()),
                             Touching::BORDERS);
    std::size_t count = 0;
    for (int row = 0; row < free.height(); ++row)
      for (int column = 0; column < free.width(); ++column) {
        const Cell cell{column, row};
        const auto number = map.at(cell);
        ASSERT_EQ(number.has_value(), free[cell] != 0);
        if (!number) continue;
        ++count;
        ASSERT_TRUE(map.rectangles()[*number].contains(cell));
      }
    EXPECT_EQ(map.freeCells(), count);
  }
}

TEST(RectangleGraph, RefusesRectanglesThatCannotBe) {
  const GridGeometry geometry(10, 6, 1.0);
  const auto refusal = [&geometry](const std::vector<CellRect>& rectangles) {
    return test::errorText([&] { RectangleGraph(geometry, rectangles, Touching::BORDERS); });
  };
  EXPECT_EQ(refusal({{0, 0, 2, 2}, {3, 3, 0, 1}}), "rectangle 1 [3, 3, 0, 1] holds no cell");
  EXPECT_EQ(refusal({{9, 0, 2, 1}}), "rectangle 0 [9, 0, 2, 1] leaves the map of 10x6 cells");
  EXPECT_EQ(refusal({{-1, 0, 2, 1}}), "rectangle 0 [-1, 0, 2, 1] leaves the map of 10x6 cells");
  EXPECT_EQ(refusal({{0, 0, 3, 3}, {5, 5, 1, 1}, {2, 2, 2, 2}}),
            "rectangle 0 [0, 0, 3, 3] overlaps rectangle 2 [2, 2, 2, 2]");
}

TEST(RectangleGraph, StopsWhenAsked) {
  StopSource stop;
  stop.cancel();
  std::vector<CellRect> rectangles;
  for (int i = 0; i < 5000; ++i) rectangles.push_back({i, 0, 1, 1});
  const GridGeometry geometry(5000, 1, 1.0);
  EXPECT_THROW(RectangleGraph(geometry, rectangles, Touching::BORDERS, stop.token()), Stopped);
  EXPECT_THROW(RectangleIndex(rectangles, stop.token()), Stopped);
  EXPECT_THROW(Connections(rectangles, Touching::BORDERS, stop.token()), Stopped);
}

TEST(RectangleIndex, FollowsAdditionsAndRemovals) {
  RectangleIndex index;
  index.add({0, 0, 4, 4}, 7);
  index.add({4, 0, 4, 4}, 2);
  EXPECT_EQ(index.at({3, 3}), std::optional<std::uint32_t>(7));
  EXPECT_EQ(index.overlapping({3, 3, 2, 1}), (std::vector<std::uint32_t>{2, 7}));
  index.remove({0, 0, 4, 4}, 7);
  EXPECT_FALSE(index.at({3, 3}));
  EXPECT_EQ(index.size(), 1U);
  EXPECT_TRUE(index.overlapping({0, 0, 0, 0}).empty());
}

}  // namespace
}  // namespace grid_path_planner::planners
