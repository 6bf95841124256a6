#include "planners/rectangles/rectangle_map_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/planners/decomposition.h"
#include "support/cost_maps.h"
#include "support/free_cells.h"

namespace grid_path_planner::planners {

using base::Status;
using base::StopToken;
using costmap::BitMaps;
using costmap::CostGrid;
using costmap::lineOfSight;
using costmap::SegmentPoint;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;

namespace {

using test::costsOf;
using test::FreeCells;
using test::freeCells;

Cell randomCell(std::mt19937& random, const FreeCells& free) {
  const int column = static_cast<int>(random() % static_cast<unsigned>(free.width()));
  return {column, static_cast<int>(random() % static_cast<unsigned>(free.height()))};
}

SearchResult plan(Planner& planner, Cell start, Cell goal) {
  return planner.search({start, {goal}, false}, StopToken());
}

SearchResult planOn(const FreeCells& free, Cell start, Cell goal) {
  RectangleMapPlanner planner;
  planner.prepare(costsOf(free), StopToken());
  return plan(planner, start, goal);
}

bool isLegal(const CostGrid& map, const SearchResult& result) {
  for (std::size_t i = 1; i < result.points.size(); ++i)
    if (!lineOfSight(map, result.points[i - 1], result.points[i])) return false;
  return !result.points.empty();
}

// --- Maps of the simplest kinds -----------------------------------------------------------------

TEST(RectangleMapPlanner, OnAMapWithoutObstacles) {
  const SearchResult result = planOn(FreeCells(GridGeometry(30, 20, 1.0), 1), {0, 0}, {29, 19});
  EXPECT_EQ(result.status, Status::FOUND);
  EXPECT_EQ(result.points.size(), 2U);
}

TEST(RectangleMapPlanner, OnAMapWithoutFreeCells) {
  const FreeCells blocked(GridGeometry(30, 20, 1.0), 0);
  const SearchResult result = planOn(blocked, {0, 0}, {29, 19});
  EXPECT_EQ(result.status, Status::START_OCCUPIED);
  EXPECT_EQ(result.message, "start (0, 0) is blocked");
}

TEST(RectangleMapPlanner, OnAMapOfOneCell) {
  EXPECT_EQ(planOn(freeCells({"."}), {0, 0}, {0, 0}).status, Status::FOUND);
  EXPECT_EQ(planOn(freeCells({"#"}), {0, 0}, {0, 0}).status, Status::START_OCCUPIED);
  EXPECT_EQ(planOn(freeCells({"."}), {0, 0}, {1, 0}).status, Status::GOAL_OUTSIDE_MAP);
}

TEST(RectangleMapPlanner, OnMapsOfOneRowOrColumn) {
  const FreeCells row = freeCells({"...#.."});
  EXPECT_EQ(planOn(row, {0, 0}, {2, 0}).status, Status::FOUND);
  EXPECT_EQ(planOn(row, {0, 0}, {5, 0}).status, Status::UNREACHABLE);
  EXPECT_EQ(planOn(row, {0, 0}, {3, 0}).status, Status::GOAL_OCCUPIED);
  const FreeCells column = freeCells({".", ".", "#", "."});
  EXPECT_EQ(planOn(column, {0, 1}, {0, 0}).status, Status::FOUND);
  EXPECT_EQ(planOn(column, {0, 3}, {0, 0}).status, Status::UNREACHABLE);
  EXPECT_EQ(planOn(column, {0, 2}, {0, 0}).status, Status::START_OCCUPIED);
}

TEST(RectangleMapPlanner, OnACheckerboard) {
  FreeCells checkers(GridGeometry(17, 16, 1.0));
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 17; ++column)
      checkers[Cell{column, row}] = (row + column) % 2 == 0 ? 1 : 0;
  EXPECT_EQ(planOn(checkers, {0, 0}, {0, 0}).status, Status::FOUND);
  EXPECT_EQ(planOn(checkers, {0, 0}, {1, 1}).status, Status::UNREACHABLE);
  EXPECT_EQ(planOn(checkers, {0, 0}, {1, 0}).status, Status::GOAL_OCCUPIED);
}

TEST(RectangleMapPlanner, RefusesAMapForWhichItHasNoMemory) {
  std::mt19937 random(1);
  FreeCells noise(GridGeometry(400, 400, 1.0));
  for (std::uint8_t& cell : noise.values()) cell = random() % 2 == 0 ? 1 : 0;
  noise[Cell{0, 0}] = 1;
  RectangleMapPlanner planner;
  planner.limitMemory(planner.bytesFor(noise.geometry()));
  planner.prepare(costsOf(noise), StopToken());
  const SearchResult refused = plan(planner, {0, 0}, {0, 0});
  EXPECT_EQ(refused.status, Status::INVALID_REQUEST);
  EXPECT_NE(refused.message.find("MB to cut this map into rectangles"), std::string::npos)
      << refused.message;
  planner.prepare(costsOf(FreeCells(noise.geometry(), 1)), StopToken());
  EXPECT_EQ(plan(planner, {0, 0}, {399, 399}).status, Status::FOUND);
}

// What tall rectangles cost shows only while they are cut.
TEST(RectangleMapPlanner, RefusesAMapThatTurnsOutToNeedMoreMemory) {
  std::mt19937 random(31);
  FreeCells sparse(GridGeometry(600, 600, 1.0), 1);
  for (std::uint8_t& cell : sparse.values()) cell = random() % 1000 != 0 ? 1 : 0;
  const BitMaps bits = test::bitMapsOf(sparse);
  const std::size_t runs = countRuns(bits.rows);
  RectangleMapPlanner planner;
  planner.limitMemory(
      std::max(largestFirstBytes(sparse.geometry(), runs), RectangleGraph::bytesFor(runs)));
  planner.prepare(costsOf(sparse), StopToken());
  const SearchResult refused = plan(planner, {0, 0}, {0, 0});
  EXPECT_EQ(refused.status, Status::INVALID_REQUEST);
  EXPECT_NE(refused.message.find("needs more than"), std::string::npos) << refused.message;
  planner.prepare(costsOf(FreeCells(sparse.geometry(), 1)), StopToken());
  EXPECT_EQ(plan(planner, {0, 0}, {599, 599}).status, Status::FOUND);
}

// --- Updates ------------------------------------------------------------------------------------

TEST(RectangleMapPlanner, SeesThatADoorWasShutAndOpened) {
  FreeCells free = freeCells({"...#...",  //
                              ".......",  //
                              "...#..."});
  RectangleMapPlanner planner;
  planner.prepare(costsOf(free), StopToken());
  EXPECT_EQ(plan(planner, {0, 0}, {6, 2}).status, Status::FOUND);
  free[Cell{3, 1}] = 0;
  planner.update(costsOf(free, 1), {{3, 1, 1, 1}}, StopToken());
  EXPECT_EQ(plan(planner, {0, 0}, {6, 2}).status, Status::UNREACHABLE);
  EXPECT_EQ(plan(planner, {0, 0}, {3, 1}).status, Status::GOAL_OCCUPIED);
  free[Cell{3, 1}] = 1;
  planner.update(costsOf(free, 2), {{3, 1, 1, 1}}, StopToken());
  EXPECT_EQ(plan(planner, {0, 0}, {6, 2}).status, Status::FOUND);
}

// As published: an even border has its middle between two cells.
TEST(RectangleMapPlanner, CrossesBordersInTheirMiddle) {
  const FreeCells free = freeCells({"..####",  //
                                    "..####",  //
                                    "......",  //
                                    "......",  //
                                    "......"});
  RectangleMapOptions options;
  options.rectangle_funnel = false;
  RectangleMapPlanner planner(options);
  planner.prepare(costsOf(free), StopToken());
  const SearchResult result = plan(planner, {0, 0}, {5, 4});
  ASSERT_EQ(result.status, Status::FOUND);
  constexpr std::int64_t kHalf = SegmentPoint::kUnitsPerCell / 2;
  EXPECT_EQ(result.points, (std::vector<SegmentPoint>{{kHalf, kHalf},
                                                      {2 * kHalf, 3 * kHalf},
                                                      {2 * kHalf, 5 * kHalf},
                                                      {11 * kHalf, 9 * kHalf}}));
}

TEST(RectangleMapPlanner, FindsPathsAfterUpdatesWhereAFreshOneDoes) {
  std::mt19937 random(20261121);
  int found = 0;
  for (int trial = 0; trial < 20; ++trial) {
    FreeCells free = test::randomBlocks(random, 60);
    RectangleMapOptions options;
    options.rectangle_weight = static_cast<RectangleWeight>(trial % 5);
    options.rectangle_funnel = trial % 2 == 0;
    RectangleMapPlanner updated(options);
    updated.prepare(costsOf(free), StopToken());
    for (std::uint64_t step = 1; step <= 40; ++step) {
      const Cell low = randomCell(random, free);
      const int side = 1 + static_cast<int>(random() % 6);
      const CellRect changed =
          CellRect{low.column, low.row, side, side}.intersection(free.geometry().rect());
      test::fillCells(free, changed, random() % 2 == 0 ? 1 : 0);
      const auto map = costsOf(free, step);
      updated.update(map, {changed}, StopToken());
      if (step % 4 != 0) continue;
      RectangleMapPlanner fresh;
      fresh.prepare(map, StopToken());
      const Cell start = randomCell(random, free), goal = randomCell(random, free);
      const SearchResult result = plan(updated, start, goal);
      ASSERT_EQ(result.status, plan(fresh, start, goal).status) << result.message;
      if (result.status != Status::FOUND) continue;
      ++found;
      ASSERT_TRUE(isLegal(*map, result));
    }
  }
  EXPECT_GT(found, 50);
}

}  // namespace
}  // namespace grid_path_planner::planners
