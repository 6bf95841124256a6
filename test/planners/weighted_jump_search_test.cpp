#include "planners/jump_point/weighted_jump_search.h"

#include <gtest/gtest.h>

#include <random>

#include "planners/jump_point/walls.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planners {

using base::Status;
using base::StopToken;
using costmap::CostGrid;
using costmap::costOfSteps;
using costmap::ExactCost;
using grid::Cell;
using grid::CellIndex;
using grid::Grid;
using grid::GridGeometry;
using test::costMap;

namespace {

WeightedJumpSearch prepared(const CostGrid& map) {
  WeightedJumpSearch search;
  search.prepare(map, StopToken());
  return search;
}

void expectLeast(WeightedJumpSearch& search, const CostGrid& map, std::mt19937& random,
                 int queries) {
  const Cell start = test::randomCell(random, map.geometry());
  if (!map.passable(start)) return;
  const auto costs = test::referenceCosts(map, start);
  for (int query = 0; query < queries; ++query) {
    const Cell goal = test::randomCell(random, map.geometry());
    if (!map.passable(goal)) continue;
    const SearchResult result = search.run(map, {start, {goal}, false}, StopToken());
    const auto least = costs[map.geometry().index(goal).value()];
    ASSERT_EQ(result.status, least ? Status::FOUND : Status::UNREACHABLE);
    if (!least) continue;
    ASSERT_EQ(result.cost, *least) << start << " to " << goal;
    ASSERT_EQ(result.cells.front(), start);
    ASSERT_EQ(result.cells.back(), goal);
    ASSERT_EQ(result.cost, costOfSteps(map, result.cells));
  }
}

TEST(WeightedJumpSearch, QueuesNothingInTheOpen) {
  const CostGrid map = costMap(Grid<CostGrid::Weight>(GridGeometry(300, 200, 1.0), 7));
  WeightedJumpSearch search = prepared(map);
  const SearchResult result = search.run(map, {{5, 5}, {{290, 150}}, false}, StopToken());
  EXPECT_EQ(result.cost, (ExactCost{140 * 7, 145 * 7}));
  EXPECT_EQ(result.statistics.expanded, 1U);
  EXPECT_EQ(result.statistics.generated, 0U);
}

TEST(WeightedJumpSearch, CrossesHighWeightsWhereThePathAroundCostsMore) {
  Grid<CostGrid::Weight> weights(GridGeometry(9, 30, 1.0), 1);
  for (int row = 0; row < 29; ++row) weights[Cell{4, row}] = 10;
  const CostGrid map = costMap(weights);
  WeightedJumpSearch search = prepared(map);
  const SearchResult across = search.run(map, {{0, 5}, {{8, 5}}, false}, StopToken());
  EXPECT_EQ(across.cost, (ExactCost{6 + 20, 0}));
  const SearchResult around = search.run(map, {{0, 25}, {{8, 25}}, false}, StopToken());
  EXPECT_EQ(around.cost, (ExactCost{0, 4 + 4})) << "four rows up and down, past its end";
}

TEST(WeightedJumpSearchLaw, FindsTheLeastCost) {
  std::mt19937 random(20261121);
  for (int trial = 0; trial < 400; ++trial) {
    const CostGrid map = test::randomCosts(random, trial % 10 == 0 ? 90 : 20, {});
    WeightedJumpSearch search = prepared(map);
    expectLeast(search, map, random, 12);
    if (HasFatalFailure()) FAIL() << "trial " << trial;
  }
}

// Few values make many equal costs, which reach a cell from several sides.
// The bound comes at the first expansion, in the midst of the search or never: cells that are open
// then are ordered anew.
TEST(WeightedJumpSearchLaw, FindsTheLeastCostWheneverTheBoundIsMade) {
  std::mt19937 random(18);
  for (int trial = 0; trial < 120; ++trial) {
    const GridGeometry geometry(30 + int(random() % 90), 30 + int(random() % 60), 1.0);
    const CostGrid map = trial % 2 == 0 ? test::randomPotential(random, geometry, {})
                                        : test::randomCosts(random, geometry, {});
    for (const std::size_t after : {1, 2, 10, 40}) {
      WeightedJumpSearch search = prepared(map);
      search.makeBoundAfter(after);
      expectLeast(search, map, random, 8);
      if (HasFatalFailure()) FAIL() << "trial " << trial << ", after " << after;
    }
  }
}

TEST(WeightedJumpSearchLaw, FindsTheLeastCostWhereManyTie) {
  std::mt19937 random(77);
  for (int trial = 0; trial < 400; ++trial) {
    Grid<CostGrid::Weight> weights(
        GridGeometry(1 + int(random() % 16), 1 + int(random() % 16), 1.0), 1);
    const unsigned values = 2 + trial % 3, blocked = trial % 5;
    for (auto& weight : weights.values())
      weight = static_cast<CostGrid::Weight>(random() % 10 < blocked ? 0 : 1 + random() % values);
    const CostGrid map = costMap(weights);
    WeightedJumpSearch search = prepared(map);
    expectLeast(search, map, random, 20);
    if (HasFatalFailure()) FAIL() << "trial " << trial;
  }
}

// Slopes are full of dead branches, and the goals lie in them.
TEST(WeightedJumpSearchLaw, FindsTheLeastCostOnSlopes) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 60; ++trial) {
    Grid<CostGrid::Weight> weights(GridGeometry(20 + int(random() % 50), 40, 1.0), 1);
    for (int i = 0; i < 3; ++i) {
      const Cell middle = test::randomCell(random, weights.geometry());
      const int top = 4 + int(random() % 20);
      for (std::uint32_t j = 0; j < weights.values().size(); ++j) {
        const Cell cell = weights.geometry().cell(CellIndex(j));
        const int away =
            std::max(std::abs(cell.column - middle.column), std::abs(cell.row - middle.row));
        const int weight = top + 1 - away;
        if (away < 3) weights[cell] = CostGrid::kBlocked;
        if (weights[cell] != CostGrid::kBlocked && weight > weights[cell])
          weights[cell] = static_cast<CostGrid::Weight>(weight);
      }
    }
    const CostGrid map = costMap(weights);
    WeightedJumpSearch search = prepared(map);
    expectLeast(search, map, random, 60);
    if (HasFatalFailure()) FAIL() << "trial " << trial;
  }
}

// The stamp of its g-values numbers the queries with 16 bits.
TEST(WeightedJumpSearch, AnswersManyQueries) {
  std::mt19937 random(9);
  Grid<CostGrid::Weight> weights(GridGeometry(4, 4, 1.0), 1);
  for (auto& weight : weights.values()) weight = static_cast<CostGrid::Weight>(1 + random() % 9);
  const CostGrid map = costMap(weights);
  WeightedJumpSearch search = prepared(map);
  const SearchRequest request{{0, 0}, {{3, 3}}, false};
  const SearchResult first = search.run(map, request, StopToken());
  for (int query = 0; query < 66000; ++query)
    ASSERT_EQ(search.run(map, request, StopToken()).cells, first.cells) << "query " << query;
}

TEST(WeightedJumpSearch, ThrowsWhereATooExpensivesItsKeys) {
  const CostGrid map = costMap(Grid<CostGrid::Weight>(GridGeometry(400, 3, 1.0), 65535));
  WeightedJumpSearch search = prepared(map);
  EXPECT_THROW(search.run(map, {{0, 0}, {{399, 2}}, false}, StopToken()), TooExpensive);
  const SearchResult near = search.run(map, {{0, 0}, {{99, 2}}, false}, StopToken());
  EXPECT_EQ(near.cost, (ExactCost{97LL * 65535, 2LL * 65535}));
}

SearchKey keyOf(const ExactCost& cost) {
  return SearchKey(cost.straight) * kMediumScale.straight +
         SearchKey(cost.diagonal) * kMediumScale.diagonal;
}

// Of a search of many more expansions than samples are kept of: nearly the share of all of them. One cheap
// cell makes the octile distance a bound that says little.
TEST(WeightedJumpSearch, TheSampleOfALongSearchIsSpreadOverIt) {
  Grid<CostGrid::Weight> weights = test::slopesBetweenWalls();
  for (CostGrid::Weight& weight : weights.values())
    if (weight != CostGrid::kBlocked) weight += 30;
  weights[Cell{0, 1}] = 1;
  const CostGrid map = costMap(weights);
  const Cell start{5, 5}, goal{630, 630};
  WeightedJumpSearch search = prepared(map);
  search.makeBoundAfter(std::size_t{1} << 30);
  const SearchResult result = search.run(map, {start, {goal}, true}, StopToken());
  const auto evidence = search.evidence(StopToken());
  ASSERT_TRUE(evidence.has_value());
  ASSERT_GT(evidence->expanded, 33000U);

  BlockBounds blocks(WeightedJumpSearch::kBlock);
  blocks.prepare(map, StopToken());
  const StopToken stop;
  const BlockEstimate bound(blocks.to(goal), kMediumScale, stop);
  bound(start);
  const auto costs = test::referenceCosts(map, start);
  double spared = 0.0;
  for (const CellIndex index : result.expanded)
    if (keyOf(*costs[index.value()]) + bound.known(map.geometry().cell(index)) >=
        keyOf(result.cost))
      ++spared;
  spared /= double(result.expanded.size());
  EXPECT_GT(spared, 0.1);
  EXPECT_LT(spared, 0.9);
  EXPECT_NEAR(evidence->spared, spared, 0.05);
}

// A run() that has to make too many tiles around its goal forgets what the last one told, too.
TEST(WeightedJumpSearch, ARunThatMayMakeNoTileForgetsTheEvidenceOfTheLastOne) {
  grid::Grid<costmap::CostGrid::Weight> weights(grid::GridGeometry(640, 640, 1.0));
  for (int row = 0; row < 640; ++row)
    for (int column = 0; column < 640; ++column)
      weights[grid::Cell{column, row}] = static_cast<costmap::CostGrid::Weight>(
          column % 50 == 25 && row % 60 < 40 ? 0 : 1 + (column * 7 + row * 5) % 23);
  const costmap::CostGrid map = test::costMap(weights);
  WeightedJumpSearch search;
  search.prepare(map, base::StopToken());
  search.makeBoundAfter(std::size_t{1} << 30);
  search.run(map, {{5, 5}, {{100, 90}}, false}, base::StopToken());
  ASSERT_TRUE(search.evidence(base::StopToken()).has_value());
  EXPECT_THROW(search.run(map, {{5, 5}, {{600, 600}}, false}, base::StopToken(), 0), TooManyTiles);
  EXPECT_FALSE(search.evidence(base::StopToken()).has_value());

  search.run(map, {{5, 5}, {{100, 90}}, false}, base::StopToken());
  search.update(map, {{0, 0, 1, 1}}, base::StopToken(), WeightedJumpSearch::kBlock);
  EXPECT_FALSE(search.evidence(base::StopToken()).has_value()) << "of the map before";
}

}  // namespace
}  // namespace grid_path_planner::planners
