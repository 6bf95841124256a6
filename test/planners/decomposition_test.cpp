#include "grid_path_planner/planners/decomposition.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <string>

#include "support/free_cells.h"

namespace grid_path_planner::planners {

using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::BitMaps;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;

namespace {

using test::bitMapsOf;
using test::FreeCells;
using test::freeCells;
using test::isPartition;
using test::publishedExample;

std::vector<CellRect> cut(const FreeCells& free, const DecompositionLimits& limits = {}) {
  return largestFirst(bitMapsOf(free), limits, StopToken());
}

// Rows as words between spaces: a rectangle's number from 1, '.' where there is none.
std::vector<std::string> labelled(const FreeCells& free, const std::vector<CellRect>& rectangles) {
  std::vector<std::string> lines;
  for (int row = 0; row < free.height(); ++row) {
    std::string line;
    for (int column = 0; column < free.width(); ++column) {
      std::string label = ".";
      for (std::size_t i = 0; i < rectangles.size(); ++i)
        if (rectangles[i].contains({column, row})) label = std::to_string(i + 1);
      line += (line.empty() ? "" : " ") + label;
    }
    lines.push_back(line);
  }
  return lines;
}

TEST(LargestFirst, CutsThePublishedExampleAsPublished) {
  const FreeCells free = publishedExample();
  const std::vector<CellRect> rectangles = cut(free);
  ASSERT_EQ(rectangles.size(), 10U);
  EXPECT_EQ(rectangles[0], (CellRect{0, 0, 2, 8}));
  EXPECT_EQ(rectangles[1], (CellRect{4, 0, 3, 4}));
  EXPECT_EQ(rectangles[2], (CellRect{4, 7, 4, 3}));
  EXPECT_EQ(rectangles[6], (CellRect{2, 3, 2, 1}));
  EXPECT_EQ(rectangles[9], (CellRect{7, 6, 1, 1}));
  EXPECT_EQ(labelled(free, rectangles),
            (std::vector<std::string>{"1 1 . . 2 2 2 6 6 6",   //
                                      "1 1 . . 2 2 2 . . .",   //
                                      "1 1 9 . 2 2 2 . . .",   //
                                      "1 1 7 7 2 2 2 4 4 4",   //
                                      "1 1 . . . . . 4 4 4",   //
                                      "1 1 . . . . . 4 4 4",   //
                                      "1 1 . . . . . 10 . .",  //
                                      "1 1 8 8 3 3 3 3 . .",   //
                                      ". . . . 3 3 3 3 . .",   //
                                      "5 5 5 5 3 3 3 3 . ."}));
}

TEST(LargestFirst, BreaksTiesByFirstColumnThenLastRowThenWidth) {
  EXPECT_EQ(cut(freeCells({"#1", "1#"})), (std::vector<CellRect>{{0, 1, 1, 1}, {1, 0, 1, 1}}));
  EXPECT_EQ(cut(freeCells({"1", "#", "1"})), (std::vector<CellRect>{{0, 0, 1, 1}, {0, 2, 1, 1}}));
  EXPECT_EQ(cut(freeCells({"1#", "11"})), (std::vector<CellRect>{{0, 1, 2, 1}, {0, 0, 1, 1}}));
}

TEST(LargestFirst, KnowsTheSimplestMaps) {
  EXPECT_EQ(cut(freeCells({"1"})), (std::vector<CellRect>{{0, 0, 1, 1}}));
  EXPECT_TRUE(cut(freeCells({"#"})).empty());
  EXPECT_TRUE(cut(freeCells({"###", "###"})).empty());
  EXPECT_EQ(cut(freeCells({"111", "111"})), (std::vector<CellRect>{{0, 0, 3, 2}}));
  EXPECT_EQ(cut(freeCells({"11#1"})), (std::vector<CellRect>{{0, 0, 2, 1}, {3, 0, 1, 1}}));
  EXPECT_EQ(cut(freeCells({"1", "1", "#", "1"})),
            (std::vector<CellRect>{{0, 0, 1, 2}, {0, 3, 1, 1}}));
  EXPECT_EQ(cut(freeCells({"1#1", "#1#", "1#1"})).size(), 5U);
}

TEST(LargestFirst, EndsAtALimit) {
  const FreeCells free = publishedExample();
  const std::vector<CellRect> all = cut(free);
  DecompositionLimits count, area;
  count.count = 4;
  EXPECT_EQ(cut(free, count), std::vector<CellRect>(all.begin(), all.begin() + 4));
  area.smallest_area = 3;
  std::vector<CellRect> large;
  for (const CellRect& rect : all)
    if (rect.width * rect.height >= 3) large.push_back(rect);
  EXPECT_EQ(cut(free, area), large);
  count.count = 0;
  EXPECT_TRUE(cut(free, count).empty());
}

TEST(RectangleSurvey, FindsWhatTryingEveryRectangleFinds) {
  std::mt19937 random(20261121);
  for (int trial = 0; trial < 300; ++trial) {
    const FreeCells free = test::randomFreeCells(random, 7, 0.5 + 0.1 * (trial % 5));
    EXPECT_EQ(test::largestRectangle(free), test::largestRectangleByTrying(free));
  }
}

TEST(LargestFirst, GivesTheRectanglesOfThePlainSurveyInItsOrder) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const FreeCells free = trial % 2 == 0
                               ? test::randomFreeCells(random, 50, 0.3 + 0.1 * (trial % 7))
                               : test::randomBlocks(random, 120);
    SCOPED_TRACE(trial);
    const std::vector<CellRect> rectangles = cut(free);
    ASSERT_EQ(rectangles, test::surveyRectangles(free, free.values().size()));
    ASSERT_TRUE(isPartition(free, rectangles));
  }
}

TEST(LargestFirst, CannotBeSurprisedByManyEqualRectangles) {
  FreeCells checkers(GridGeometry(65, 64, 1.0));
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 65; ++column)
      checkers[Cell{column, row}] = (row + column) % 2 == 0 ? 1 : 0;
  const std::vector<CellRect> rectangles = cut(checkers);
  EXPECT_EQ(rectangles.size(), 65U * 64U / 2U);
  EXPECT_EQ(rectangles, test::surveyRectangles(checkers, checkers.values().size()));
}

// Tall rectangles cut the runs of many rows: the heap grows far beyond the runs that the map has.
TEST(LargestFirst, TakesNoMoreMemoryThanAllowed) {
  std::mt19937 random(31);
  FreeCells sparse(GridGeometry(600, 600, 1.0), 1);
  for (std::uint8_t& cell : sparse.values()) cell = random() % 1000 != 0 ? 1 : 0;
  const BitMaps bits = bitMapsOf(sparse);
  DecompositionLimits limits;
  limits.bytes = bits.bytes() - 1;
  EXPECT_THROW(largestFirst(bits, limits, StopToken()), DecompositionTooLarge);
  limits.bytes = largestFirstBytes(sparse.geometry(), countRuns(bits.rows));
  EXPECT_THROW(largestFirst(bits, limits, StopToken()), DecompositionTooLarge);
  limits.bytes *= 10;
  EXPECT_EQ(largestFirst(bits, limits, StopToken()), cut(sparse));
}

TEST(LargestFirst, StopsWhenAsked) {
  StopSource stop;
  stop.cancel();
  const FreeCells free(GridGeometry(3000, 3000, 1.0), 1);
  EXPECT_THROW(largestFirst(bitMapsOf(free), {}, stop.token()), Stopped);
}

TEST(MergedRuns, IsAPartition) {
  EXPECT_EQ(mergedRuns(bitMapsOf(freeCells({"11#", "11#", "111"})).rows, StopToken()),
            (std::vector<CellRect>{{0, 0, 2, 2}, {0, 2, 3, 1}}));
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const FreeCells free =
        trial % 2 == 0 ? test::randomFreeCells(random, 80, 0.6) : test::randomBlocks(random, 90);
    ASSERT_TRUE(isPartition(free, mergedRuns(bitMapsOf(free).rows, StopToken())));
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
