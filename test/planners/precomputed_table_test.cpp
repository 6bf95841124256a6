// Tables that are made in the background: what is planned meanwhile, after changes of the map, and
// when nobody waits for them. Run under ThreadSanitizer, too.
#include "planners/tables/precomputed_table.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <new>
#include <random>

#include "planners/astar/a_star.h"
#include "planners/tables/landmark_table.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planners {

using base::Status;
using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::CostGrid;
using costmap::MotionModel;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;

namespace {

AStarOptions guidedBy(Heuristic heuristic) {
  AStarOptions options;
  options.heuristic = heuristic;
  options.landmarks = 4;
  return options;
}

// The next revision of `map`, with other weights in a rectangle.
std::shared_ptr<const CostGrid> next(std::mt19937& random, const CostGrid& map, CellRect& changed) {
  const Cell low = test::randomCell(random, map.geometry());
  changed = CellRect{low.column, low.row, 5, 5}.intersection(map.geometry().rect());
  Grid<CostGrid::Weight> weights = map.weights();
  for (int row = changed.row; row < changed.row + changed.height; ++row)
    for (int column = changed.column; column < changed.column + changed.width; ++column)
      weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 4);
  auto after = std::make_shared<CostGrid>(weights, map.classes(), map.motion());
  after->setRevision(map.revision() + 1);
  return after;
}

void expectLeastCost(Planner& planner, const CostGrid& map, std::mt19937& random) {
  const SearchRequest request{
      test::randomCell(random, map.geometry()), {test::randomCell(random, map.geometry())}, false};
  const SearchResult result = planner.search(request, StopToken());
  const auto costs = test::referenceCosts(map, request.start);
  const auto least = costs[map.geometry().index(request.goals.front()).value()];
  ASSERT_EQ(result.status == Status::FOUND, least.has_value()) << result.message;
  if (least) {
    EXPECT_EQ(result.cost, *least);
  }
}

class InTheBackground : public ::testing::TestWithParam<Heuristic> {};

// Whether a plan comes before the table, or changes before it is there or after, is left to chance.
TEST_P(InTheBackground, AnswersAreTheLeastCostWhateverIsReady) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 5; ++trial) {
    auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 40, {}));
    AStar planner(guidedBy(GetParam()));
    planner.prepare(map, StopToken());
    for (int change = 0; change < 12; ++change) {
      if (random() % 3 == 0) planner.finishBackgroundWork(StopToken());
      expectLeastCost(planner, *map, random);
      CellRect changed;
      map = next(random, *map, changed);
      planner.update(map, {changed}, StopToken());
      expectLeastCost(planner, *map, random);
    }
  }
}

TEST_P(InTheBackground, ATableIsThereInTheEndAndSaysWhatItTook) {
  std::mt19937 random(11);
  AStar planner(guidedBy(GetParam()));
  planner.prepare(std::make_shared<const CostGrid>(test::randomCosts(random, 40, {})), StopToken());
  planner.finishBackgroundWork(StopToken());
  const BackgroundWork work = planner.backgroundWork();
  EXPECT_FALSE(work.pending);
  EXPECT_GT(work.bytes, 0U);
  EXPECT_GT(work.time_s, 0.0);
}

// A table of this map takes a while: the destructor and the next map do not wait for it.
TEST_P(InTheBackground, ThatNobodyWaitsForIsStopped) {
  const auto map = test::costsOf(test::Weights(GridGeometry(80, 80, 1.0), 3));
  for (int i = 0; i < 10; ++i) {
    AStar planner(guidedBy(GetParam()));
    planner.prepare(map, StopToken());
    planner.prepare(map, StopToken());
    EXPECT_EQ(planner.search({{0, 0}, {{79, 0}}, false}, StopToken()).status, Status::FOUND);
  }
  AStar planner(guidedBy(GetParam()));
  planner.prepare(map, StopToken());
  StopSource stop;
  stop.cancel();
  try {
    planner.finishBackgroundWork(stop.token());
  } catch (const Stopped& stopped) {
    EXPECT_EQ(stopped.status(), Status::CANCELLED);
  }
}

INSTANTIATE_TEST_SUITE_P(Heuristics, InTheBackground,
                         ::testing::Values(Heuristic::LANDMARK, Heuristic::EXACT));

TEST(Background, HasALowPriorityAndTheCallerItsOwn) {
  const int before = getpriority(PRIO_PROCESS, 0);
  Background<int> asked;
  asked.start([](const StopToken&) { return getpriority(PRIO_PROCESS, 0); });
  asked.wait(StopToken());
  EXPECT_EQ(*asked.take(), std::max(10, before));
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), before);
}

TEST(PrecomputedTable, IsNeitherThereNorAwaitedWhereMemoryLackedAndCanBeMadeLater) {
  const auto map = test::costsOf(Grid<CostGrid::Weight>(GridGeometry(50, 50, 1.0), 1));
  bool lacks = true;
  PrecomputedTable<LandmarkTable> tables([&lacks](const CostGrid& costs, const StopToken& stop) {
    if (lacks) throw std::bad_alloc();
    return LandmarkTable(costs, 4, stop);
  });
  tables.prepare(map);
  tables.wait(StopToken());
  EXPECT_FALSE(tables.ready());
  EXPECT_FALSE(tables.work().pending);
  EXPECT_FALSE(tables.worn());
  EXPECT_FALSE(tables.made());
  tables.follow(*map, *map, {map->geometry().rect()});
  lacks = false;
  tables.prepare(map);
  tables.wait(StopToken());
  EXPECT_TRUE(tables.ready());
}

// Where nothing but obstacles appear the table serves on, and so do repaired ones: far fewer cells
// are expanded than by distance alone.
TEST(PrecomputedTable, GuidesOnAfterChanges) {
  std::mt19937 random(12);
  const GridGeometry geometry(200, 200, 1.0);
  Grid<CostGrid::Weight> weights(geometry, 1);
  for (auto& weight : weights.values()) weight = static_cast<CostGrid::Weight>(1 + random() % 9);
  auto map = test::costsOf(weights);
  AStar guided(guidedBy(Heuristic::LANDMARK));
  AStar plain(guidedBy(Heuristic::OCTILE));
  guided.prepare(map, StopToken());
  plain.prepare(map, StopToken());
  guided.finishBackgroundWork(StopToken());
  const SearchRequest request{{10, 10}, {{180, 150}}, false};
  for (int change = 0; change < 3; ++change) {
    for (int row = 90; row < 96; ++row)
      weights[Cell{60 + change, row}] = change == 1 ? CostGrid::kBlocked : 1;
    auto after = std::make_shared<CostGrid>(weights, map->classes(), MotionModel());
    after->setRevision(map->revision() + 1);
    map = after;
    const CellRect changed{60 + change, 90, 1, 6};
    guided.update(map, {changed}, StopToken());
    plain.update(map, {changed}, StopToken());
    EXPECT_FALSE(guided.backgroundWork().pending);
    const SearchResult a = guided.search(request, StopToken());
    const SearchResult b = plain.search(request, StopToken());
    EXPECT_EQ(a.cost, b.cost);
    EXPECT_LT(a.statistics.expanded, b.statistics.expanded * 3 / 4);
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
