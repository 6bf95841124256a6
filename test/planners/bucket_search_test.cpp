#include "planners/astar/bucket_search.h"

#include <gtest/gtest.h>

#include <random>

#include "planners/astar/a_star.h"
#include "planners/astar/dijkstra.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planners {

using base::Status;
using base::StopToken;
using costmap::CostGrid;
using costmap::ExactCost;
using grid::Cell;
using grid::CellIndex;
using grid::Grid;
using grid::GridGeometry;
using test::costsOf;

namespace {

// A corridor that winds over the whole map, one cell wide.
std::shared_ptr<const CostGrid> snake(int side, CostGrid::Weight weight) {
  Grid<CostGrid::Weight> weights(GridGeometry(side, side, 1.0), weight);
  for (int row = 1; row < side; row += 2)
    for (int column = 0; column < side; ++column)
      if (column != (row % 4 == 1 ? side - 1 : 0)) weights[Cell{column, row}] = CostGrid::kBlocked;
  return costsOf(std::move(weights));
}

SearchResult planOn(Planner& planner, Cell start, Cell goal) {
  return planner.search({start, {goal}, false}, StopToken());
}

constexpr std::size_t kPackedBytes = PackedNodes::kBytes + 1, kWideBytes = WideNodes::kBytes + 1;

// 24 cells of weight 65535 a side: the sides fit into small keys, the corridor does not.
TEST(BucketSearch, RepeatsWithWideKeysWhereTheCostIsTooLarge) {
  const auto map = snake(24, 65535);
  AStar planner;
  planner.prepare(map, StopToken());
  const SearchResult near = planOn(planner, {0, 0}, {9, 0});
  EXPECT_EQ(near.cost, (ExactCost{9 * 65535, 0}));
  EXPECT_LT(near.statistics.search_bytes, 24 * 24 * kPackedBytes + 400);

  const SearchResult far = planOn(planner, {0, 0}, {0, 22});
  ASSERT_EQ(far.status, Status::FOUND);
  EXPECT_EQ(far.cost, *test::referenceCosts(*map, {0, 0})[22 * 24]);
  EXPECT_GT(far.statistics.search_bytes, 24 * 24 * kWideBytes);

  const SearchResult again = planOn(planner, {0, 0}, {9, 0});
  EXPECT_EQ(again.cells, near.cells);
  EXPECT_EQ(again.statistics.search_bytes, near.statistics.search_bytes);
}

TEST(BucketSearch, UsesWideKeysFromTheStartWhereTheSidesAloneAreTooExpensive) {
  const auto map = snake(60, 65535);
  Dijkstra planner;
  planner.prepare(map, StopToken());
  const SearchResult result = planOn(planner, {0, 0}, {59, 58});
  EXPECT_EQ(result.cost, *test::referenceCosts(*map, {0, 0})[58 * 60 + 59]);
  EXPECT_LE(result.statistics.expanded, result.statistics.generated);
  EXPECT_EQ(result.statistics.reopened, 0u);
  EXPECT_GT(result.statistics.search_bytes, 60 * 60 * kWideBytes);
}

// After 4095 queries the numbers in the nodes begin again.
TEST(BucketSearch, AnswersTheSameAfterThousandsOfQueries) {
  std::mt19937 random(4095);
  const auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 20, {}));
  Dijkstra planner;
  planner.prepare(map, StopToken());
  std::vector<SearchRequest> requests;
  std::vector<SearchResult> first;
  for (int i = 0; i < 50; ++i) {
    requests.push_back({test::randomCell(random, map->geometry()),
                        {test::randomCell(random, map->geometry())},
                        false});
    first.push_back(planner.search(requests.back(), StopToken()));
  }
  for (std::size_t i = 0; i < 9000; ++i) {
    const SearchResult result = planner.search(requests[i % requests.size()], StopToken());
    ASSERT_EQ(result.status, first[i % requests.size()].status) << i;
    ASSERT_EQ(result.cells, first[i % requests.size()].cells) << i;
  }
}

// On an open map of one weight each cell is generated about once, since only canonical moves are
// tried.
TEST(BucketSearch, GeneratesACellAboutOnceInTheOpen) {
  const auto map = costsOf(Grid<CostGrid::Weight>(GridGeometry(80, 60, 1.0), 3));
  Dijkstra planner;
  planner.prepare(map, StopToken());
  const SearchResult result = planOn(planner, {30, 20}, {79, 59});
  EXPECT_EQ(result.cost, (ExactCost{30, 117}));
  EXPECT_LE(result.statistics.generated, 80u * 60u + 20u);
}

// Weights in patches: canonical moves inside, all others between. Ties are many.
TEST(BucketSearchLaw, IsOptimalWherePatchesOfOneWeightMeet) {
  std::mt19937 random(31);
  for (int trial = 0; trial < 60; ++trial) {
    const GridGeometry geometry(12 + static_cast<int>(random() % 40),
                                12 + static_cast<int>(random() % 40), 1.0);
    Grid<CostGrid::Weight> weights(geometry, 1);
    for (int patch = 0; patch < 8; ++patch) {
      const Cell low = test::randomCell(random, geometry);
      const auto weight = static_cast<CostGrid::Weight>(random() % 4);
      const int side = 2 + static_cast<int>(random() % 12);
      for (int row = low.row; row < std::min(low.row + side, geometry.height()); ++row)
        for (int column = low.column; column < std::min(low.column + side, geometry.width());
             ++column)
          weights[Cell{column, row}] = weight;
    }
    const auto map = costsOf(std::move(weights));
    const Cell start = test::randomCell(random, geometry);
    if (!map->passable(start)) continue;
    const auto least = test::referenceCosts(*map, start);
    AStar a_star;
    Dijkstra dijkstra;
    a_star.prepare(map, StopToken());
    dijkstra.prepare(map, StopToken());
    for (int query = 0; query < 40; ++query) {
      const Cell goal = test::randomCell(random, geometry);
      const auto& cost = least[geometry.index(goal).value()];
      for (Planner* planner : {static_cast<Planner*>(&a_star), static_cast<Planner*>(&dijkstra)}) {
        const SearchResult result = planOn(*planner, start, goal);
        ASSERT_EQ(result.status == Status::FOUND, cost.has_value());
        if (cost) {
          ASSERT_EQ(result.cost, *cost) << planner->traits().name << " trial " << trial;
        }
      }
    }
  }
}

TEST(CellOfIndex, IsTheGeometrysCell) {
  std::mt19937 random(6);
  for (const auto& [width, height] : std::vector<std::pair<int, int>>{{1, 1},
                                                                      {1, 524288},
                                                                      {524288, 1},
                                                                      {524288, 4095},
                                                                      {4095, 524288},
                                                                      {46340, 46340},
                                                                      {3, 7},
                                                                      {1024, 1024},
                                                                      {32767, 65535}}) {
    const GridGeometry geometry(width, height, 1.0);
    const CellOfIndex cellOf(geometry);
    const auto last = static_cast<std::uint32_t>(geometry.size() - 1);
    std::vector<std::uint32_t> indices = {0, last};
    for (int i = 0; i < 2000; ++i) {
      const std::uint32_t row_start = random() % static_cast<std::uint32_t>(height) * width;
      indices.push_back(row_start);
      indices.push_back(row_start + width - 1);
      indices.push_back(static_cast<std::uint32_t>(random()) % (last + 1U));
    }
    for (const std::uint32_t index : indices)
      ASSERT_EQ(cellOf(index), geometry.cell(CellIndex(index))) << width << 'x' << height;
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
