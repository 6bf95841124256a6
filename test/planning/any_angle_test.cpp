// The pictures and laws of the planners that find the shortest path at any angle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "support/ascii_map.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/visibility_graph.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopToken;
using costmap::CostGrid;
using costmap::CostmapOptions;
using costmap::lineCost;
using costmap::lineOfSight;
using costmap::MotionModel;
using costmap::SegmentPoint;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using grid::Occupancy;
using grid::OccupancyGrid;
using planners::makePlanner;
using planners::Planner;
using planners::SearchRequest;
using planners::SearchResult;

namespace {

using test::costsOf;

SegmentPoint corner(int column, int row) {
  return {column * SegmentPoint::kUnitsPerCell, row * SegmentPoint::kUnitsPerCell};
}

class AnyAngle : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Planner> make() const { return makePlanner(GetParam(), {}); }

  SearchResult planOn(const std::shared_ptr<const CostGrid>& map, Cell start, Cell goal) const {
    const auto planner = make();
    planner->prepare(map, StopToken());
    return planner->search({start, {goal}, false}, StopToken());
  }
  SearchResult planOn(const test::AsciiMap& picture) const {
    return planOn(costsOf(picture.map), picture.start, picture.goal);
  }
};

TEST_P(AnyAngle, CrossesOpenWaterInOneLine) {
  const SearchResult result = planOn(test::AsciiMap({"S......",  //
                                                     ".......",  //
                                                     "......G"}));
  EXPECT_EQ(result.cells, (std::vector<Cell>{{0, 0}, {6, 2}}));
  EXPECT_DOUBLE_EQ(result.costValue(), std::hypot(6, 2));
}

TEST_P(AnyAngle, TurnsAtCornersOfCells) {
  const SearchResult result = planOn(test::AsciiMap({"S..#..G",  //
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

// A flat node: the path turns at a corner on its root's line, to the other side.
TEST_P(AnyAngle, FollowsAWallAndTurnsAtItsEnd) {
  const SearchResult result = planOn(test::AsciiMap({"...#...",  //
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

TEST_P(AnyAngle, DoesNotSqueezeThroughACorner) {
  EXPECT_EQ(planOn(test::AsciiMap({"S#",  //
                                   "#G"}))
                .status,
            Status::UNREACHABLE);
}

TEST_P(AnyAngle, GrazesCorners) {
  const SearchResult result = planOn(test::AsciiMap({"S...##",  //
                                                     "#.....",  //
                                                     "##...G"}));
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_EQ(result.cells, (std::vector<Cell>{{0, 0}, {5, 2}}));
  EXPECT_DOUBLE_EQ(result.costValue(), std::hypot(5, 2));
}

TEST_P(AnyAngle, StaysWhereItIs) {
  const auto map = costsOf(test::AsciiMap({"S.G"}).map);
  const SearchResult result = planOn(map, {1, 0}, {1, 0});
  EXPECT_EQ(result.cells, std::vector<Cell>{(Cell{1, 0})});
  EXPECT_EQ(result.points, std::vector<SegmentPoint>{SegmentPoint::centreOf({1, 0})});
  EXPECT_EQ(result.costValue(), 0.0);
}

TEST_P(AnyAngle, KnowsTheSmallestMaps) {
  const auto cell = costsOf(OccupancyGrid(GridGeometry(1, 1, 1.0), 0));
  EXPECT_EQ(planOn(cell, {0, 0}, {0, 0}).status, Status::FOUND);
  EXPECT_DOUBLE_EQ(planOn(test::AsciiMap({"S.........G"})).costValue(), 10.0);
  EXPECT_EQ(planOn(test::AsciiMap({"S....#....G"})).status, Status::UNREACHABLE);
}

TEST_P(AnyAngle, FindsNoPathOverACheckerboard) {
  OccupancyGrid board(GridGeometry(40, 40, 1.0), 0);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column)
      if ((row + column) % 2 == 1) board[Cell{column, row}] = 100;
  EXPECT_EQ(planOn(costsOf(board), {0, 0}, {38, 38}).status, Status::UNREACHABLE);
}

TEST_P(AnyAngle, SeesAMapThatChanged) {
  const auto planner = make();
  const auto before = costsOf(test::AsciiMap({".....", "..#..", "....."}).map);
  planner->prepare(before, StopToken());
  EXPECT_GT(planner->search({{0, 1}, {{4, 1}}, false}, StopToken()).costValue(), 4.0);
  auto after =
      std::make_shared<CostGrid>(*costsOf(test::AsciiMap({".....", ".....", "....."}).map));
  after->setRevision(before->revision() + 1);
  planner->update(after, {{2, 1, 1, 1}}, StopToken());
  EXPECT_DOUBLE_EQ(planner->search({{0, 1}, {{4, 1}}, false}, StopToken()).costValue(), 4.0);
}

TEST_P(AnyAngle, SaysWhatItCannotPlanWith) {
  EXPECT_EQ(planOn(test::AsciiMap({"S?G"})).message,
            GetParam() +
                " plans only where all passable cells weigh the same, and these weigh 1 to 50: set "
                "unknown_is_passable false or unknown_weight to free_weight, or take a_star");
  CostmapOptions inflated;
  inflated.decay = 1.0;
  EXPECT_EQ(planOn(costsOf(test::AsciiMap({"S..#..G"}).map, inflated), {0, 0}, {2, 0}).message,
            GetParam() +
                " plans only where all passable cells weigh the same, and these weigh 4 to 25: set "
                "decay 0, or take a_star");
  CostmapOptions options;
  options.motion.cut_corners = true;
  const SearchResult result = planOn(costsOf(test::AsciiMap({"S.G"}).map, options), {0, 0}, {2, 0});
  EXPECT_EQ(result.status, Status::INVALID_REQUEST);
  EXPECT_EQ(result.message, GetParam() + " does not plan with cut_corners, which a_star does");
}

// One weight, whatever it is; rectangles or single cells blocked.
std::shared_ptr<const CostGrid> randomUniform(std::mt19937& random, int largest_side) {
  const auto below = [&random](int limit) { return static_cast<int>(random() % limit); };
  const auto weight = static_cast<CostGrid::Weight>(1 + below(3));
  Grid<CostGrid::Weight> weights(
      GridGeometry(1 + below(largest_side), 1 + below(largest_side), 1.0), weight);
  const bool rectangles = below(2) == 0;
  const double share = below(500) * 1e-3;
  const int wanted =
      static_cast<int>(share * (rectangles ? 20.0 : double(weights.values().size())));
  for (int i = 0; i < wanted; ++i) {
    const Cell low = test::randomCell(random, weights.geometry());
    const CellRect rect =
        CellRect{low.column, low.row, rectangles ? 1 + below(5) : 1, rectangles ? 1 + below(5) : 1}
            .intersection(weights.geometry().rect());
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      std::fill_n(weights.row(row) + rect.column, rect.width, CostGrid::kBlocked);
  }
  const Grid<Occupancy> classes(weights.geometry(), Occupancy::FREE);
  return std::make_shared<const CostGrid>(weights, classes, MotionModel());
}

// A legal path of the length that the visibility graph finds, and none where there is none. `found`
// counts the former.
void expectShortest(Planner& planner, const std::shared_ptr<const CostGrid>& map, Cell start,
                    Cell goal, int& found) {
  planner.prepare(map, StopToken());
  const SearchResult result = planner.search({start, {goal}, false}, StopToken());
  const auto shortest = test::shortestAnyAngle(*map, start, goal);
  ASSERT_EQ(result.status, shortest ? Status::FOUND : Status::UNREACHABLE);
  if (!shortest) return;
  ++found;
  const double scale = map->minWeight() * map->kernel();
  EXPECT_NEAR(result.costValue(), *shortest * scale, 1e-9 * *shortest * scale);
  double cost = 0.0;
  for (std::size_t i = 1; i < result.points.size(); ++i) {
    ASSERT_TRUE(lineOfSight(*map, result.points[i - 1], result.points[i]));
    cost += lineCost(*map, result.points[i - 1], result.points[i]);
  }
  EXPECT_NEAR(result.costValue(), cost, 1e-9 * cost);
}

TEST_P(AnyAngle, IsAsShortAsTheVisibilityGraph) {
  std::mt19937 random(2016);
  int found = 0;
  const auto planner = make();
  for (int trial = 0; trial < 6000; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const auto map = randomUniform(random, 16);
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    if (map->passable(start) && map->passable(goal))
      expectShortest(*planner, map, start, goal, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 2500);
}

// Words are 64 cells: what lies across their edges.
TEST_P(AnyAngle, IsAsShortAsTheVisibilityGraphOnWideMaps) {
  std::mt19937 random(64);
  int found = 0;
  const auto planner = make();
  for (int trial = 0; trial < 150; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    OccupancyGrid picture(GridGeometry(120 + trial % 20, 6, 1.0), 0);
    for (auto& value : picture.values()) value = random() % 8 == 0 ? 100 : 0;
    const auto map = costsOf(picture);
    const Cell start{static_cast<int>(random() % 60), static_cast<int>(random() % 6)};
    const Cell goal{70 + static_cast<int>(random() % 50), static_cast<int>(random() % 6)};
    if (map->passable(start) && map->passable(goal))
      expectShortest(*planner, map, start, goal, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 50);
}

// In the last blocks of a kernel a path does not pass through the middle.
TEST_P(AnyAngle, IsAsShortAsTheVisibilityGraphOverBlocks) {
  std::mt19937 random(3);
  int found = 0;
  const auto planner = make();
  for (int trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    CostmapOptions options;
    options.kernel = 2 + trial % 4;
    const auto map = costsOf(test::randomOccupancy(random, 40, 0.04, 0.0), options);
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    if (map->passable(start) && map->passable(goal))
      expectShortest(*planner, map, start, goal, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 150);
}

INSTANTIATE_TEST_SUITE_P(All, AnyAngle, ::testing::Values("anya", "polyanya"),
                         [](const auto& info) { return info.param; });

// Discs: walls of many steps, along which an interval crosses one border after another.
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

void expectTheSame(const std::shared_ptr<const CostGrid>& map, std::mt19937& random, int queries,
                   int& found) {
  const auto planner = makePlanner("polyanya", {}), anya = makePlanner("anya", {});
  planner->prepare(map, StopToken());
  anya->prepare(map, StopToken());
  for (int query = 0; query < queries; ++query) {
    const SearchRequest request{test::randomCell(random, map->geometry()),
                                {test::randomCell(random, map->geometry())},
                                false};
    const SearchResult result = planner->search(request, StopToken());
    const SearchResult other = anya->search(request, StopToken());
    ASSERT_EQ(result.status, other.status);
    if (result.status != Status::FOUND) continue;
    ASSERT_NEAR(result.costValue(), other.costValue(), 1e-9 * other.costValue());
    ++found;
  }
}

// Larger than the visibility graph allows; many queries on each.
TEST(AnyAngleLaw, AllAreAsShort) {
  std::mt19937 random(20);
  int found = 0;
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const auto map = trial % 2 == 0
                         ? randomUniform(random, 150)
                         : costsOf(test::randomOccupancy(random, 150, 0.1 + trial * 0.005, 0.0));
    expectTheSame(map, random, 50, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 1000);
}

TEST(AnyAngleLaw, AllAreAsShortAmongRoundObstacles) {
  std::mt19937 random(8);
  int found = 0;
  for (int trial = 0; trial < 8; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    expectTheSame(roundObstacles(random, 300), random, 60, found);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace grid_path_planner::planning
