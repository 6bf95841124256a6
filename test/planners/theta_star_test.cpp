#include "planners/any_angle/theta_star.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/path/smoothing.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "planners/any_angle/turning_points.h"
#include "support/ascii_map.h"
#include "support/cost_maps.h"
#include "support/random_map.h"

namespace grid_path_planner::planners {

using base::Status;
using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::CostmapOptions;
using grid::Cell;

namespace {

using test::costsOf;

SearchResult thetaStarOn(const std::shared_ptr<const CostGrid>& map, Cell start, Cell goal) {
  LazyThetaStar planner;
  planner.prepare(map, StopToken());
  return planner.search({start, {goal}, false}, StopToken());
}

SearchResult thetaStarOn(const test::AsciiMap& picture) {
  return thetaStarOn(costsOf(picture.map), picture.start, picture.goal);
}

TEST(LazyThetaStar, CrossesOpenWaterInOneLine) {
  const SearchResult result = thetaStarOn(test::AsciiMap({"S......",  //
                                                          ".......",  //
                                                          "......G"}));
  EXPECT_EQ(result.cells, (std::vector<Cell>{{0, 0}, {6, 2}}));
  EXPECT_NEAR(result.costValue(), std::hypot(6, 2), 1e-12);
}

TEST(LazyThetaStar, TurnsOnlyAtCorners) {
  const SearchResult result = thetaStarOn(test::AsciiMap({"S..#...",  //
                                                          "...#...",  //
                                                          ".......",  //
                                                          "......G"}));
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_LE(result.cells.size(), 4u);
  EXPECT_LT(result.costValue(), 3.0 + 3.0 * std::sqrt(2.0)) << "what a grid path costs";
}

// navigation2#2520, #2690: crosses expensive cells although a path around them costs less.
TEST(LazyThetaStar, AvoidsExpensiveCells) {
  const test::AsciiMap picture({"........",  //
                                "S.????.G",  //
                                "..????.."});
  const SearchResult result = thetaStarOn(picture);
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_LT(result.costValue(), 10.0) << "straight through unknown cells: 50 a cell";
}

// navigation2#5863: a segment squeezes between two obstacles that touch at a corner.
TEST(LazyThetaStar, DoesNotSqueezeThroughACorner) {
  EXPECT_EQ(thetaStarOn(test::AsciiMap({"S#",  //
                                        "#G"}))
                .status,
            Status::UNREACHABLE);
}

// The query stamp wraps around after 16,383 queries.
// On a gentle potential the straight distance at the least weight says next to nothing: by it nearly
// all of the 8,000 cells were expanded.
TEST(LazyThetaStar, GoesAlongAGentleValley) {
  grid::Grid<CostGrid::Weight> weights(grid::GridGeometry(200, 40, 1.0), 5);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 200; ++column)
      weights[Cell{column, row}] = static_cast<CostGrid::Weight>(5 + std::abs(row - 20));
  weights[Cell{199, 39}] = 1;
  const auto map = test::costsOf(weights, costmap::MotionModel(), 1);
  const SearchResult result = thetaStarOn(map, {184, 20}, {4, 20});
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_NEAR(result.costValue(), 180 * 5, 1e-9);
  EXPECT_LT(result.statistics.expanded, 4000U);
}

TEST(LazyThetaStar, ALateQueryIsAnsweredLikeTheFirst) {
  const test::AsciiMap picture({"S.#.",  //
                                "...G"});
  const auto map = costsOf(picture.map);
  LazyThetaStar planner;
  planner.prepare(map, StopToken());
  const SearchRequest there{picture.start, {picture.goal}, false};
  const SearchRequest back{picture.goal, {picture.start}, false};
  const SearchResult first = planner.search(there, StopToken());
  for (int i = 0; i < 17000; ++i) {
    const SearchResult again = planner.search(i % 2 == 0 ? back : there, StopToken());
    ASSERT_EQ(again.status, Status::FOUND) << "query " << i;
    ASSERT_NEAR(again.costValue(), first.costValue(), 1e-12);
    if (i % 2 == 1) {
      ASSERT_EQ(again.cells, first.cells) << "query " << i;
    }
  }
}

// Gentle potentials, as users are told to have, and noise.
std::shared_ptr<const CostGrid> weightedMap(std::mt19937& random, bool gentle) {
  return std::make_shared<const CostGrid>(
      gentle ? test::randomPotential(random, grid::GridGeometry(60, 50, 1.0), {})
             : test::randomCosts(random, 50, {}));
}

double costOfSegments(const CostGrid& map, const std::vector<Cell>& cells) {
  double sum = 0.0;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const auto cost = costmap::lineCostWithin(map, cells[i - 1], cells[i]);
    EXPECT_TRUE(cost) << "a segment is not legal";
    sum += cost.value_or(0.0);
  }
  return sum;
}

// Of several least-cost paths of steps the guide has another than A*, so one may be smoothed to a little less.
TEST(LazyThetaStarLaw, IsNoCostlierThanTheLeastPathOfStepsSmoothed) {
  std::mt19937 random(18);
  double theta = 0.0, steps = 0.0;
  int found = 0, costlier = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto map = weightedMap(random, trial % 2 == 0);
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    const SearchResult any_angle = thetaStarOn(map, start, goal);
    const auto a_star = makePlanner("a_star");
    a_star->prepare(map, StopToken());
    const SearchResult grid = a_star->search({start, {goal}, false}, StopToken());
    ASSERT_EQ(any_angle.status, grid.status) << trial;
    if (any_angle.status != Status::FOUND) continue;
    std::vector<costmap::SegmentPoint> points;
    for (const Cell cell : grid.cells) points.push_back(costmap::waypointOf(*map, cell));
    const double smoothed = path::smoothed(*map, points, StopToken()).cost;
    EXPECT_LE(any_angle.costValue(), grid.costValue() * (1.0 + 1e-9)) << trial;
    EXPECT_NEAR(any_angle.costValue(), costOfSegments(*map, any_angle.cells), 1e-6);
    ++found;
    costlier += any_angle.costValue() > smoothed * (1.0 + 1e-9);
    theta += any_angle.costValue();
    steps += grid.costValue();
  }
  EXPECT_GT(found, 150);
  EXPECT_LT(costlier, 0.05 * found);
  EXPECT_LT(theta, 0.97 * steps);
}

// With one weight before, between and after, where there is no guide.
TEST(LazyThetaStarLaw, AnUpdatedMapIsAnsweredLikeANewOne) {
  std::mt19937 random(19);
  const grid::GridGeometry geometry(40, 30, 1.0);
  grid::Grid<CostGrid::Weight> weights(geometry, 3);
  LazyThetaStar planner;
  planner.prepare(test::costsOf(weights, costmap::MotionModel(), 1), StopToken());
  for (std::uint64_t revision = 2; revision < 60; ++revision) {
    const grid::CellRect changed{static_cast<int>(random() % 30), static_cast<int>(random() % 20),
                                 10, 10};
    const bool all_equal = revision % 7 == 0;
    if (all_equal) weights = grid::Grid<CostGrid::Weight>(geometry, 3);
    for (int row = changed.row; row < changed.row + 10 && !all_equal; ++row)
      for (int column = changed.column; column < changed.column + 10; ++column)
        weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 4 * 3);
    const auto map = test::costsOf(weights, costmap::MotionModel(), revision);
    planner.update(map, {all_equal ? grid::CellRect{0, 0, 40, 30} : changed}, StopToken());
    const Cell start = test::randomCell(random, geometry),
               goal = test::randomCell(random, geometry);
    const SearchResult updated = planner.search({start, {goal}, false}, StopToken());
    const SearchResult fresh = thetaStarOn(map, start, goal);
    ASSERT_EQ(updated.status, fresh.status) << revision;
    EXPECT_EQ(updated.cells, fresh.cells) << revision;
  }
}

TEST(TurningPoints, ARoughPathIsPulledIntoTheValley) {
  grid::Grid<CostGrid::Weight> weights(grid::GridGeometry(60, 30, 1.0), 0);
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 60; ++column)
      weights[Cell{column, row}] = static_cast<CostGrid::Weight>(10 + 4 * std::abs(row - 15));
  const auto map = test::costsOf(weights, costmap::MotionModel(), 1);
  const std::vector<Cell> rough = {{2, 5}, {30, 28}, {57, 5}};
  const std::vector<Cell> cells = tightened(*map, rough, StopToken());
  EXPECT_EQ(cells.front(), rough.front());
  EXPECT_EQ(cells.back(), rough.back());
  EXPECT_LT(costOfSegments(*map, cells), 0.62 * costOfSegments(*map, rough));
  const SearchResult best = thetaStarOn(map, rough.front(), rough.back());
  EXPECT_LT(costOfSegments(*map, cells), 1.02 * best.costValue());
}

TEST(TurningPointsLaw, TheEndsStayAndNothingGetsCostlier) {
  std::mt19937 random(20);
  for (int trial = 0; trial < 200; ++trial) {
    const auto map = weightedMap(random, trial % 2 == 0);
    const auto a_star = makePlanner("a_star");
    a_star->prepare(map, StopToken());
    const SearchResult grid = a_star->search({test::randomCell(random, map->geometry()),
                                              {test::randomCell(random, map->geometry())},
                                              false},
                                             StopToken());
    if (grid.status != Status::FOUND) continue;
    const std::vector<Cell> cells = tightened(*map, grid.cells, StopToken());
    EXPECT_EQ(cells.front(), grid.cells.front());
    EXPECT_EQ(cells.back(), grid.cells.back());
    EXPECT_LE(costOfSegments(*map, cells), grid.costValue() * (1.0 + 1e-9));
  }
}

TEST(LazyThetaStar, SaysWhatItCannotPlanWith) {
  CostmapOptions options;
  options.motion.connectivity = Connectivity::FOUR;
  const SearchResult result =
      thetaStarOn(costsOf(test::AsciiMap({"S.G"}).map, options), {0, 0}, {2, 0});
  EXPECT_EQ(result.status, Status::INVALID_REQUEST);
  EXPECT_EQ(result.message, "lazy_theta_star does not plan with connectivity 4, which a_star does");
}

}  // namespace
}  // namespace grid_path_planner::planners
