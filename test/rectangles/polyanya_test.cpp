#include "grid_path_planner/rectangles/polyanya.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid_path_planner/search/anya.h"
#include "support/ascii_map.h"
#include "support/costs_of.h"
#include "support/random_map.h"
#include "support/shortest_any_angle.h"

namespace grid_path_planner {
namespace {

using test::costsOf;

PlanResult planOn(const std::shared_ptr<const CostGrid>& map, Cell start, Cell goal) {
  Polyanya planner;
  planner.prepare(map, StopToken());
  return planner.plan({start, {goal}, false}, StopToken());
}

PlanResult planOn(const test::AsciiMap& picture) {
  return planOn(costsOf(picture.map), picture.start, picture.goal);
}

SegmentPoint corner(int column, int row) {
  return {column * SegmentPoint::kUnitsPerCell, row * SegmentPoint::kUnitsPerCell};
}

TEST(Polyanya, SeesTheGoalInItsOwnRectangle) {
  const PlanResult result = planOn(test::AsciiMap({"S......",  //
                                                   ".......",  //
                                                   "......G"}));
  EXPECT_EQ(result.cells, (std::vector<Cell>{{0, 0}, {6, 2}}));
  EXPECT_DOUBLE_EQ(result.costValue(), std::hypot(6, 2));
  EXPECT_EQ(result.statistics.expanded, 0U);
}

TEST(Polyanya, SeesThroughRectangles) {
  const PlanResult result = planOn(test::AsciiMap({"S...##",  //
                                                   "#.....",  //
                                                   "##...G"}));
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_EQ(result.cells, (std::vector<Cell>{{0, 0}, {5, 2}}));
  EXPECT_DOUBLE_EQ(result.costValue(), std::hypot(5, 2));
}

TEST(Polyanya, TurnsAtCornersOfCells) {
  const PlanResult result = planOn(test::AsciiMap({"S..#..G",  //
                                                   "...#...",  //
                                                   "......."}));
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_EQ(result.points,
            (std::vector<SegmentPoint>{SegmentPoint::centreOf({0, 0}), corner(3, 2), corner(4, 2),
                                       SegmentPoint::centreOf({6, 0})}));
  EXPECT_EQ(result.cells.front(), (Cell{0, 0}));
  EXPECT_EQ(result.cells.back(), (Cell{6, 0}));
  EXPECT_DOUBLE_EQ(result.costValue(), 2 * std::hypot(2.5, 1.5) + 1.0);
}

// Two corners on one line between rectangles.
TEST(Polyanya, FollowsAWallAndTurnsAtItsEnd) {
  const PlanResult result = planOn(test::AsciiMap({"...#...",  //
                                                   "S..#...",  //
                                                   "...####",  //
                                                   ".......",  //
                                                   ".#####.",  //
                                                   ".....#G"}));
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_EQ(result.points,
            (std::vector<SegmentPoint>{SegmentPoint::centreOf({0, 1}), corner(3, 3), corner(6, 4),
                                       SegmentPoint::centreOf({6, 5})}));
}

TEST(Polyanya, DoesNotSqueezeThroughACorner) {
  EXPECT_EQ(planOn(test::AsciiMap({"S#",  //
                                   "#G"}))
                .status,
            Status::UNREACHABLE);
}

TEST(Polyanya, SeesAtOnceThatNoWayLeads) {
  const PlanResult result = planOn(test::AsciiMap({"...#...",  //
                                                   ".S.#.G.",  //
                                                   "...#..."}));
  EXPECT_EQ(result.status, Status::UNREACHABLE);
  EXPECT_EQ(result.statistics.generated, 0U);
}

// Neither the bay above nor the chambers below are on the way.
TEST(Polyanya, LeavesOutWhatLeadsNowhereElse) {
  const PlanResult result = planOn(test::AsciiMap({"##...##########",  //
                                                   "S.............G",  //
                                                   "####.#####.####",  //
                                                   "####.#####...##",  //
                                                   "####...####..##"}));
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_EQ(result.statistics.generated, 0U);
}

TEST(Polyanya, StaysWhereItIs) {
  const auto map = costsOf(test::AsciiMap({"S.G"}).map);
  const PlanResult result = planOn(map, {1, 0}, {1, 0});
  EXPECT_EQ(result.cells, std::vector<Cell>{(Cell{1, 0})});
  EXPECT_EQ(result.points, std::vector<SegmentPoint>{SegmentPoint::centreOf({1, 0})});
  EXPECT_EQ(result.costValue(), 0.0);
}

TEST(Polyanya, KnowsTheSmallestMaps) {
  const auto cell = costsOf(OccupancyGrid(GridGeometry(1, 1, 1.0), 0));
  EXPECT_EQ(planOn(cell, {0, 0}, {0, 0}).status, Status::FOUND);
  EXPECT_DOUBLE_EQ(planOn(test::AsciiMap({"S.........G"})).costValue(), 10.0);
  EXPECT_EQ(planOn(test::AsciiMap({"S....#....G"})).status, Status::UNREACHABLE);
}

TEST(Polyanya, FindsNoWayOverACheckerboard) {
  OccupancyGrid board(GridGeometry(40, 40, 1.0), 0);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column)
      if ((row + column) % 2 == 1) board[Cell{column, row}] = 100;
  EXPECT_EQ(planOn(costsOf(board), {0, 0}, {38, 38}).status, Status::UNREACHABLE);
}

TEST(Polyanya, SeesAMapThatChanged) {
  Polyanya planner;
  const auto before = costsOf(test::AsciiMap({".....", "..#..", "....."}).map);
  planner.prepare(before, StopToken());
  EXPECT_GT(planner.plan({{0, 1}, {{4, 1}}, false}, StopToken()).costValue(), 4.0);
  auto after =
      std::make_shared<CostGrid>(*costsOf(test::AsciiMap({".....", ".....", "....."}).map));
  after->setRevision(before->revision() + 1);
  planner.update(after, {2, 1, 1, 1}, StopToken());
  EXPECT_DOUBLE_EQ(planner.plan({{0, 1}, {{4, 1}}, false}, StopToken()).costValue(), 4.0);
}

TEST(Polyanya, SaysWhatItCannotPlanWith) {
  EXPECT_EQ(planOn(test::AsciiMap({"S?G"})).message,
            "polyanya plans only where all passable cells weigh the same, and these weigh 1 to 50: "
            "set unknown_is_passable false or unknown_weight to free_weight, or take a_star");
  TerrainOptions options;
  options.motion.cut_corners = true;
  const PlanResult result = planOn(costsOf(test::AsciiMap({"S.G"}).map, options), {0, 0}, {2, 0});
  EXPECT_EQ(result.status, Status::INVALID_REQUEST);
  EXPECT_EQ(result.message, "polyanya does not plan with cut_corners, which a_star does");
}

TEST(PolyanyaLaw, IsAsShortAsTheVisibilityGraph) {
  std::mt19937 random(2017);
  int found = 0;
  Polyanya planner;
  for (int trial = 0; trial < 6000; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const auto map = test::randomUniform(random, 16);
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    if (map->passable(start) && map->passable(goal))
      test::expectShortest(planner, map, start, goal, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 2500);
}

// In the last blocks of a kernel a path does not pass through the middle.
TEST(PolyanyaLaw, IsAsShortAsTheVisibilityGraphOverBlocks) {
  std::mt19937 random(3);
  int found = 0;
  Polyanya planner;
  for (int trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    TerrainOptions options;
    options.kernel = 2 + trial % 4;
    const auto map = costsOf(test::randomOccupancy(random, 40, 0.04, 0.0), options);
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    if (map->passable(start) && map->passable(goal))
      test::expectShortest(planner, map, start, goal, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 150);
}

// Discs: walls of many steps, along which a cone meets one border after another.
std::shared_ptr<const CostGrid> roundObstacles(std::mt19937& random, int side) {
  OccupancyGrid picture(GridGeometry(side, side, 1.0), 0);
  for (int disc = 0; disc < side / 8; ++disc) {
    const Cell middle = test::randomCell(random, picture.geometry());
    const int radius = 2 + static_cast<int>(random() % 20);
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column)
        if (std::hypot(column - middle.column, row - middle.row) < radius)
          picture[Cell{column, row}] = 100;
  }
  return costsOf(picture);
}

void expectAsShortAsAnya(const std::shared_ptr<const CostGrid>& map, std::mt19937& random,
                         int queries, int& found) {
  Polyanya planner;
  Anya anya;
  planner.prepare(map, StopToken());
  anya.prepare(map, StopToken());
  for (int query = 0; query < queries; ++query) {
    const PlanRequest request{test::randomCell(random, map->geometry()),
                              {test::randomCell(random, map->geometry())},
                              false};
    const PlanResult result = planner.plan(request, StopToken());
    const PlanResult other = anya.plan(request, StopToken());
    ASSERT_EQ(result.status, other.status);
    if (result.status != Status::FOUND) continue;
    ASSERT_NEAR(result.costValue(), other.costValue(), 1e-9 * other.costValue());
    ++found;
  }
}

// Larger than the visibility graph can look at; many queries on each.
TEST(PolyanyaLaw, IsAsShortAsAnya) {
  std::mt19937 random(20);
  int found = 0;
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const auto map = trial % 2 == 0
                         ? test::randomUniform(random, 150)
                         : costsOf(test::randomOccupancy(random, 150, 0.1 + trial * 0.005, 0.0));
    expectAsShortAsAnya(map, random, 50, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 1000);
}

TEST(PolyanyaLaw, IsAsShortAsAnyaAmongRoundObstacles) {
  std::mt19937 random(8);
  int found = 0;
  for (int trial = 0; trial < 8; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    expectAsShortAsAnya(roundObstacles(random, 300), random, 60, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace grid_path_planner
