#include "grid_path_planner/search/anya.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/ascii_map.h"
#include "support/costs_of.h"
#include "support/random_map.h"
#include "support/shortest_any_angle.h"

namespace grid_path_planner {
namespace {

using test::costsOf;

PlanResult planOn(const std::shared_ptr<const CostGrid>& map, Cell start, Cell goal) {
  Anya planner;
  planner.prepare(map, StopToken());
  return planner.plan({start, {goal}, false}, StopToken());
}

PlanResult planOn(const test::AsciiMap& picture) {
  return planOn(costsOf(picture.map), picture.start, picture.goal);
}

SegmentPoint corner(int column, int row) {
  return {column * SegmentPoint::kUnitsPerCell, row * SegmentPoint::kUnitsPerCell};
}

TEST(Anya, CrossesOpenWaterInOneLine) {
  const PlanResult result = planOn(test::AsciiMap({"S......",  //
                                                   ".......",  //
                                                   "......G"}));
  EXPECT_EQ(result.cells, (std::vector<Cell>{{0, 0}, {6, 2}}));
  EXPECT_DOUBLE_EQ(result.costValue(), std::hypot(6, 2));
}

TEST(Anya, TurnsAtCornersOfCells) {
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

// A corner met along a line between rows: round it to the other side.
TEST(Anya, FollowsAWallAndTurnsAtItsEnd) {
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

TEST(Anya, DoesNotSqueezeThroughACorner) {
  EXPECT_EQ(planOn(test::AsciiMap({"S#",  //
                                   "#G"}))
                .status,
            Status::UNREACHABLE);
}

TEST(Anya, StaysWhereItIs) {
  const auto map = costsOf(test::AsciiMap({"S.G"}).map);
  const PlanResult result = planOn(map, {1, 0}, {1, 0});
  EXPECT_EQ(result.cells, std::vector<Cell>{(Cell{1, 0})});
  EXPECT_EQ(result.points, std::vector<SegmentPoint>{SegmentPoint::centreOf({1, 0})});
  EXPECT_EQ(result.costValue(), 0.0);
}

TEST(Anya, SaysWhatItCannotPlanWith) {
  EXPECT_EQ(planOn(test::AsciiMap({"S?G"})).message,
            "anya plans only where all passable cells weigh the same, and these weigh 1 to 50: set "
            "unknown_is_passable false or unknown_weight to free_weight, or take a_star");
  TerrainOptions inflated;
  inflated.decay = 1.0;
  EXPECT_EQ(planOn(costsOf(test::AsciiMap({"S..#..G"}).map, inflated), {0, 0}, {2, 0}).message,
            "anya plans only where all passable cells weigh the same, and these weigh 4 to 25: set "
            "decay 0, or take a_star");
  TerrainOptions options;
  options.motion.cut_corners = true;
  const PlanResult result = planOn(costsOf(test::AsciiMap({"S.G"}).map, options), {0, 0}, {2, 0});
  EXPECT_EQ(result.status, Status::INVALID_REQUEST);
  EXPECT_EQ(result.message, "anya does not plan with cut_corners, which a_star does");
}

void expectShortest(const std::shared_ptr<const CostGrid>& map, Cell start, Cell goal, int& found) {
  Anya planner;
  test::expectShortest(planner, map, start, goal, found);
}

TEST(AnyaLaw, IsAsShortAsTheVisibilityGraph) {
  std::mt19937 random(2016);
  int found = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const auto map = test::randomUniform(random, 16);
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    if (map->passable(start) && map->passable(goal)) expectShortest(map, start, goal, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 2500);
}

// Words are 64 cells: what lies across their edges.
TEST(AnyaLaw, IsAsShortAsTheVisibilityGraphOnWideMaps) {
  std::mt19937 random(64);
  int found = 0;
  for (int trial = 0; trial < 150; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    OccupancyGrid picture(GridGeometry(120 + trial % 20, 6, 1.0), 0);
    for (auto& value : picture.values()) value = random() % 8 == 0 ? 100 : 0;
    const auto map = costsOf(picture);
    const Cell start{static_cast<int>(random() % 60), static_cast<int>(random() % 6)};
    const Cell goal{70 + static_cast<int>(random() % 50), static_cast<int>(random() % 6)};
    if (map->passable(start) && map->passable(goal)) expectShortest(map, start, goal, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 50);
}

// In the last blocks of a kernel a path does not pass through the middle.
TEST(AnyaLaw, IsAsShortAsTheVisibilityGraphOverBlocks) {
  std::mt19937 random(3);
  int found = 0;
  for (int trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    TerrainOptions options;
    options.kernel = 2 + trial % 4;
    const auto map = costsOf(test::randomOccupancy(random, 40, 0.04, 0.0), options);
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    if (map->passable(start) && map->passable(goal)) expectShortest(map, start, goal, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 150);
}

}  // namespace
}  // namespace grid_path_planner
