// The rectangles that polyanya does not enter. test/planning/any_angle_test.cpp tests its paths.
#include "planners/any_angle/polyanya.h"

#include <gtest/gtest.h>

#include "support/ascii_map.h"
#include "support/cost_maps.h"

namespace grid_path_planner::planners {

using base::Status;
using base::StopToken;
using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

SearchResult polyanyaOn(const test::AsciiMap& picture) {
  Polyanya planner;
  planner.prepare(test::costsOf(picture.map), StopToken());
  return planner.search({picture.start, {picture.goal}, false}, StopToken());
}

TEST(Polyanya, SeesTheGoalInItsOwnRectangle) {
  const SearchResult result = polyanyaOn(test::AsciiMap({"S......",  //
                                                         ".......",  //
                                                         "......G"}));
  EXPECT_EQ(result.status, Status::FOUND);
  EXPECT_EQ(result.statistics.expanded, 0U);
}

TEST(Polyanya, ExpandsNothingWhereThereIsNoPath) {
  const SearchResult result = polyanyaOn(test::AsciiMap({"...#...",  //
                                                         ".S.#.G.",  //
                                                         "...#..."}));
  EXPECT_EQ(result.status, Status::UNREACHABLE);
  EXPECT_EQ(result.statistics.generated, 0U);
}

// Neither the bay above nor the chambers below are on the path.
TEST(Polyanya, LeavesOutWhatLeadsNowhereElse) {
  const SearchResult result = polyanyaOn(test::AsciiMap({"##...##########",  //
                                                         "S.............G",  //
                                                         "####.#####.####",  //
                                                         "####.#####...##",  //
                                                         "####...####..##"}));
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_EQ(result.statistics.generated, 0U);
}

TEST(Polyanya, RefusesMapsOfTooManyRectangles) {
  OccupancyGrid board(GridGeometry(100, 100, 1.0), 0);
  for (int row = 0; row < 100; ++row)
    for (int column = row % 2; column < 100; column += 2) board[Cell{column, row}] = 100;
  Polyanya planner;
  planner.limitMemory(2000000);
  planner.prepare(test::costsOf(board), StopToken());
  const SearchResult result = planner.search({{1, 0}, {{3, 0}}, false}, StopToken());
  EXPECT_EQ(result.status, Status::INVALID_REQUEST);
  EXPECT_EQ(result.message,
            "polyanya needs up to 4 MB to cut this map into rectangles, more than the 2 MB that "
            "memory_limit leaves it");
  EXPECT_TRUE(planner.rectangles().empty());
}

}  // namespace
}  // namespace grid_path_planner::planners
