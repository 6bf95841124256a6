#include "grid_path_planner/search/weighted_jump_point.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner {
namespace {

std::shared_ptr<const CostGrid> shared(const Grid<CostGrid::Weight>& weights,
                                       const MotionModel& motion = {}, std::uint64_t revision = 0) {
  auto map = std::make_shared<CostGrid>(
      weights, Grid<Occupancy>(weights.geometry(), Occupancy::FREE), motion);
  map->setRevision(revision);
  return map;
}

void expectLeast(WeightedJumpPoint& planner, const CostGrid& map, std::mt19937& random,
                 int queries) {
  const Cell start = test::randomCell(random, map.geometry());
  if (!map.passable(start)) return;
  const auto costs = test::referenceCosts(map, start);
  for (int query = 0; query < queries; ++query) {
    const Cell goal = test::randomCell(random, map.geometry());
    if (!map.passable(goal)) continue;
    const PlanResult result = planner.plan({start, {goal}, false}, StopToken());
    const auto least = costs[map.geometry().index(goal).value()];
    ASSERT_EQ(result.status, least ? Status::FOUND : Status::UNREACHABLE);
    if (!least) continue;
    ASSERT_EQ(result.cost, *least) << start << " to " << goal;
    ASSERT_EQ(result.cells.front(), start);
    ASSERT_EQ(result.cells.back(), goal);
    ASSERT_EQ(result.cost, costOfSteps(map, result.cells));
  }
}

TEST(WeightedJumpPoint, QueuesNothingInTheOpen) {
  const auto map = shared(Grid<CostGrid::Weight>(GridGeometry(300, 200, 1.0), 7));
  WeightedJumpPoint planner;
  planner.prepare(map, StopToken());
  const PlanResult result = planner.plan({{5, 5}, {{290, 150}}, false}, StopToken());
  EXPECT_EQ(result.cost, (ExactCost{140 * 7, 145 * 7}));
  EXPECT_EQ(result.statistics.expanded, 1U);
  EXPECT_EQ(result.statistics.generated, 0U);
}

TEST(WeightedJumpPoint, CrossesWhatIsDearWhereTheDetourIsDearer) {
  Grid<CostGrid::Weight> weights(GridGeometry(9, 30, 1.0), 1);
  for (int row = 0; row < 29; ++row) weights[Cell{4, row}] = 10;
  WeightedJumpPoint planner;
  planner.prepare(shared(weights), StopToken());
  const PlanResult across = planner.plan({{0, 5}, {{8, 5}}, false}, StopToken());
  EXPECT_EQ(across.cost, (ExactCost{6 + 20, 0}));
  const PlanResult around = planner.plan({{0, 25}, {{8, 25}}, false}, StopToken());
  EXPECT_EQ(around.cost, (ExactCost{0, 4 + 4})) << "four rows up and down, past its end";
}

TEST(WeightedJumpPointLaw, FindsTheLeastCost) {
  std::mt19937 random(20261121);
  for (int trial = 0; trial < 400; ++trial) {
    const CostGrid map = test::randomCosts(random, trial % 10 == 0 ? 90 : 20, {});
    WeightedJumpPoint planner;
    planner.prepare(std::make_shared<const CostGrid>(map), StopToken());
    expectLeast(planner, map, random, 12);
    if (HasFatalFailure()) FAIL() << "trial " << trial;
  }
}

// Few values make many equal costs, which reach a cell from several sides.
TEST(WeightedJumpPointLaw, FindsTheLeastCostWhereManyTie) {
  std::mt19937 random(77);
  for (int trial = 0; trial < 400; ++trial) {
    Grid<CostGrid::Weight> weights(
        GridGeometry(1 + int(random() % 16), 1 + int(random() % 16), 1.0), 1);
    const unsigned values = 2 + trial % 3, blocked = trial % 5;
    for (auto& weight : weights.values())
      weight = static_cast<CostGrid::Weight>(random() % 10 < blocked ? 0 : 1 + random() % values);
    const auto map = shared(weights);
    WeightedJumpPoint planner;
    planner.prepare(map, StopToken());
    expectLeast(planner, *map, random, 20);
    if (HasFatalFailure()) FAIL() << "trial " << trial;
  }
}

TEST(WeightedJumpPointLaw, AfterEditsPlansLikeAFreshOne) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 40; ++trial) {
    auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 40, {}));
    WeightedJumpPoint edited;
    edited.prepare(map, StopToken());
    for (int edit = 0; edit < 8; ++edit) {
      const Cell low = test::randomCell(random, map->geometry());
      const CellRect changed =
          CellRect{low.column, low.row, 1 + int(random() % 5), 1 + int(random() % 5)}.intersection(
              map->geometry().rect());
      Grid<CostGrid::Weight> weights = map->weights();
      for (int row = changed.row; row < changed.row + changed.height; ++row)
        for (int column = changed.column; column < changed.column + changed.width; ++column)
          weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 5);
      map = shared(weights, {}, map->revision() + 1);
      edited.update(map, changed, StopToken());
      WeightedJumpPoint fresh;
      fresh.prepare(map, StopToken());
      for (int query = 0; query < 5; ++query) {
        const PlanRequest request{test::randomCell(random, map->geometry()),
                                  {test::randomCell(random, map->geometry())},
                                  true};
        const PlanResult a = edited.plan(request, StopToken());
        const PlanResult b = fresh.plan(request, StopToken());
        ASSERT_EQ(a.status, b.status);
        ASSERT_EQ(a.cells, b.cells);
        ASSERT_EQ(a.expanded, b.expanded);
      }
      expectLeast(edited, *map, random, 5);
    }
  }
}

// 17.6e6 cell lengths x weight are what its own keys hold.
TEST(WeightedJumpPoint, LeavesDearPathsToAStar) {
  const auto map = shared(Grid<CostGrid::Weight>(GridGeometry(400, 3, 1.0), 65535));
  WeightedJumpPoint planner;
  planner.prepare(map, StopToken());
  const PlanResult result = planner.plan({{0, 0}, {{399, 2}}, false}, StopToken());
  EXPECT_EQ(result.status, Status::FOUND);
  EXPECT_EQ(result.cost, (ExactCost{397LL * 65535, 2LL * 65535}));
  const PlanResult cheap = planner.plan({{0, 0}, {{99, 2}}, false}, StopToken());
  EXPECT_EQ(cheap.cost, (ExactCost{97LL * 65535, 2LL * 65535}));
}

// Its labels number the queries with 16 bits.
TEST(WeightedJumpPoint, AnswersManyQueries) {
  std::mt19937 random(9);
  Grid<CostGrid::Weight> weights(GridGeometry(4, 4, 1.0), 1);
  for (auto& weight : weights.values()) weight = static_cast<CostGrid::Weight>(1 + random() % 9);
  const auto map = shared(weights);
  WeightedJumpPoint planner;
  planner.prepare(map, StopToken());
  const PlanRequest request{{0, 0}, {{3, 3}}, false};
  const PlanResult first = planner.plan(request, StopToken());
  for (int query = 0; query < 66000; ++query) {
    const PlanResult result = planner.plan(request, StopToken());
    ASSERT_EQ(result.cells, first.cells) << "query " << query;
  }
}

}  // namespace
}  // namespace grid_path_planner
