// Jump point search: turns by pictures, then that its costs are those of Boost.Graph's Dijkstra on
// maps of every density, after edits too.
#include "planners/jump_point/jump_point.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "support/ascii_map.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planners {

using base::Status;
using base::StopToken;
using costmap::CostGrid;
using costmap::CostmapBuilder;
using costmap::CostmapOptions;
using costmap::costOfSteps;
using costmap::ExactCost;
using costmap::stepAllowed;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;
using test::costsOf;
using test::Weights;

namespace {

Weights blockedWith(std::mt19937& random, int width, int height, double share,
                    CostGrid::Weight weight) {
  Weights weights(GridGeometry(width, height, 1.0), weight);
  std::bernoulli_distribution blocked(share);
  for (auto& each : weights.values())
    if (blocked(random)) each = CostGrid::kBlocked;
  return weights;
}

SearchResult planned(const test::AsciiMap& picture, const CostmapOptions& options = {}) {
  CostmapBuilder builder(options);
  builder.setMap(std::make_shared<OccupancyGrid>(picture.map));
  JumpPoint planner;
  planner.prepare(builder.downsampled(StopToken()), StopToken());
  return planner.search({picture.start, {picture.goal}, false}, StopToken());
}

TEST(JumpPoint, TurnsWhereAnObstacleEnds) {
  const SearchResult result = planned(test::AsciiMap({"S.#..",  //
                                                      "..#.G",  //
                                                      ".....",  //
                                                      "....."}));
  ASSERT_EQ(result.status, Status::FOUND);
  const std::vector<Cell> expected = {{0, 0}, {1, 1}, {1, 2}, {2, 2}, {3, 2}, {4, 1}};
  EXPECT_EQ(result.cells, expected);
  EXPECT_EQ(result.cost, (ExactCost{3, 2}));
}

TEST(JumpPoint, GoesDiagonallyThenStraightInTheOpen) {
  const SearchResult result = planned(test::AsciiMap({"S....",  //
                                                      ".....",  //
                                                      "....G"}));
  const std::vector<Cell> expected = {{0, 0}, {1, 1}, {2, 2}, {3, 2}, {4, 2}};
  EXPECT_EQ(result.cells, expected);
  EXPECT_EQ(result.statistics.expanded, 2U);
}

TEST(JumpPoint, SaysWhyItRefusesAMap) {
  const test::AsciiMap picture({"S?G"});
  const SearchResult refused = planned(picture);
  EXPECT_EQ(refused.status, Status::INVALID_REQUEST);
  EXPECT_NE(refused.message.find("weigh 1 to 50"), std::string::npos) << refused.message;
  EXPECT_NE(refused.message.find("unknown_weight"), std::string::npos) << refused.message;

  CostmapOptions free_unknown;
  free_unknown.unknown_weight = free_unknown.free_weight = 3;
  const SearchResult free_result = planned(picture, free_unknown);
  EXPECT_EQ(free_result.status, Status::FOUND);
  EXPECT_EQ(free_result.cost, (ExactCost{6, 0}));
  CostmapOptions blocked_unknown;
  blocked_unknown.unknown_is_passable = false;
  EXPECT_EQ(planned(picture, blocked_unknown).status, Status::UNREACHABLE);
}

// From one cell to many, on one map.
void expectLeastCosts(std::mt19937& random, const std::shared_ptr<const CostGrid>& map,
                      JumpPoint& planner, int queries) {
  const Cell start = test::randomCell(random, map->geometry());
  const auto least = test::referenceCosts(*map, start);
  for (int query = 0; query < queries; ++query) {
    const Cell goal = test::randomCell(random, map->geometry());
    const SearchResult result = planner.search({start, {goal}, false}, StopToken());
    if (!map->passable(start) || !map->passable(goal)) continue;
    const auto& cost = least[map->geometry().index(goal).value()];
    ASSERT_EQ(result.status, cost ? Status::FOUND : Status::UNREACHABLE) << start << goal;
    if (!cost) continue;
    ASSERT_EQ(result.cost, *cost) << start << goal;
    ASSERT_EQ(result.cells.front(), start);
    ASSERT_EQ(result.cells.back(), goal);
    for (std::size_t i = 1; i < result.cells.size(); ++i)
      ASSERT_TRUE(stepAllowed(*map, result.cells[i - 1], result.cells[i]));
    ASSERT_EQ(costOfSteps(*map, result.cells), result.cost);
  }
}

TEST(JumpPoint, FindsTheLeastCostAtEveryDensity) {
  std::mt19937 random(20261121);
  for (int trial = 0; trial < 1200; ++trial) {
    const int largest = trial % 60 == 0 ? 200 : 30;
    const double share = std::uniform_real_distribution<double>(0.0, 0.55)(random);
    const auto map =
        costsOf(blockedWith(random, 1 + int(random() % largest), 1 + int(random() % largest), share,
                            static_cast<CostGrid::Weight>(1 + random() % 65535)));
    JumpPoint planner;
    planner.prepare(map, StopToken());
    SCOPED_TRACE("trial " + std::to_string(trial));
    ASSERT_NO_FATAL_FAILURE(expectLeastCosts(random, map, planner, 12));
  }
}

TEST(JumpPoint, PlansAfterEditsAsIfPreparedAnew) {
  std::mt19937 random(7);
  for (int sequence = 0; sequence < 20; ++sequence) {
    const double share = std::uniform_real_distribution<double>(0.0, 0.4)(random);
    auto map =
        costsOf(blockedWith(random, 20 + int(random() % 100), 20 + int(random() % 100), share, 1));
    JumpPoint planner;
    planner.prepare(map, StopToken());
    for (int edit = 0; edit < 20; ++edit) {
      Weights weights = map->weights();
      const Cell low = test::randomCell(random, weights.geometry());
      const CellRect changed =
          CellRect{low.column, low.row, 1 + int(random() % 9), 1 + int(random() % 9)}.intersection(
              weights.geometry().rect());
      std::bernoulli_distribution blocked(share);
      for (int row = changed.row; row < changed.row + changed.height; ++row)
        for (int column = changed.column; column < changed.column + changed.width; ++column)
          weights[Cell{column, row}] = blocked(random) ? CostGrid::kBlocked : 1;
      map = costsOf(weights, {}, map->revision() + 1);
      planner.update(map, {changed}, StopToken());
      JumpPoint fresh;
      fresh.prepare(map, StopToken());
      for (int query = 0; query < 5; ++query) {
        const SearchRequest request{test::randomCell(random, map->geometry()),
                                    {test::randomCell(random, map->geometry())},
                                    false};
        const SearchResult a = planner.search(request, StopToken());
        const SearchResult b = fresh.search(request, StopToken());
        ASSERT_EQ(a.status, b.status);
        ASSERT_EQ(a.cells, b.cells);
      }
    }
  }
}

// A serpentine whose length no 32-bit key holds: 47,321 cell lengths.
TEST(JumpPoint, FindsPathsThatOverflowThirtyTwoBits) {
  Weights weights(GridGeometry(301, 501, 1.0), 2);
  for (int row = 1; row < 501; row += 2)
    for (int column = 0; column < 301; ++column)
      if (column != (row % 4 == 1 ? 300 : 0)) weights[Cell{column, row}] = CostGrid::kBlocked;
  const auto map = costsOf(weights);
  JumpPoint planner;
  planner.prepare(map, StopToken());
  const SearchResult result = planner.search({{0, 0}, {{300, 500}}, false}, StopToken());
  ASSERT_EQ(result.status, Status::FOUND) << result.message;
  EXPECT_EQ(result.cost, costOfSteps(*map, result.cells));
  EXPECT_EQ(result.cost, (ExactCost{2 * (251 * 300 + 500), 0}));
}

}  // namespace
}  // namespace grid_path_planner::planners
