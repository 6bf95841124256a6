// Jumps that landmarks bound, asked for or paid for: least costs on any map and after any change, fewer expansions, and A*
// where jumps may not.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "planners/jump_point/walls.h"
#include "planners/jump_point/weighted_jump_point.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planners {
namespace {

using base::Status, base::StopToken;
using costmap::CostGrid, costmap::MotionModel;
using grid::Cell, grid::CellRect, grid::Grid, grid::GridGeometry;
using test::costsOf, test::slopesBetweenWalls;

const SearchRequest kFarAcross{{5, 5}, {{630, 630}}, false};

AStarOptions withLandmarks() {
  AStarOptions options;
  options.heuristic = Heuristic::LANDMARK;
  return options;
}

void expectLeastFrom(WeightedJumpPoint& planner, const CostGrid& map, Cell start,
                     std::mt19937& random, std::size_t& by_jumps) {
  const auto costs = test::referenceCosts(map, start);
  for (int query = 0; query < 12; ++query) {
    const Cell goal = test::randomCell(random, map.geometry());
    if (!map.passable(goal)) continue;
    const SearchResult result = planner.search({start, {goal}, false}, StopToken());
    const auto least = costs[map.geometry().index(goal).value()];
    ASSERT_EQ(result.status, least ? Status::FOUND : Status::UNREACHABLE) << start << goal;
    if (!least) continue;
    ASSERT_EQ(result.cost, *least) << start << " to " << goal;
    if (result.answered_by == "weighted_jump_point") ++by_jumps;
  }
}

// Raises, lowers, blocks and frees what lies in the rectangles.
std::vector<CellRect> change(Grid<CostGrid::Weight>& weights, std::mt19937& random) {
  std::vector<CellRect> changed = test::randomRects(random, weights.geometry(), 8);
  for (CellRect& rect : changed) {
    rect = rect.intersection({0, 0, weights.geometry().width(), weights.geometry().height()});
    const auto kind = random() % 4;
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      for (int column = rect.column; column < rect.column + rect.width; ++column) {
        auto& weight = weights[Cell{column, row}];
        if (kind == 0) weight = CostGrid::kBlocked;
        if (kind == 1) weight = static_cast<CostGrid::Weight>(1 + random() % 3);
        if (kind == 2 && weight != CostGrid::kBlocked)
          weight = static_cast<CostGrid::Weight>(std::max(1, weight / 2));
        if (kind == 3 && weight != CostGrid::kBlocked)
          weight = static_cast<CostGrid::Weight>(std::min(200, weight + 20));
      }
  }
  return changed;
}

// Tables are older than the map where nobody waits for new ones. Returns how many paths jumps found.
std::size_t expectLeastWhileMapsChange(const AStarOptions& options, int seed) {
  std::mt19937 random(seed);
  std::size_t by_jumps = 0;
  for (int i = 0; i < 60; ++i) {
    const GridGeometry geometry(20 + static_cast<int>(random() % 50),
                                20 + static_cast<int>(random() % 50), 1.0);
    const CostGrid made = i % 2 == 0 ? test::randomPotential(random, geometry, MotionModel())
                                     : test::randomCosts(random, geometry, MotionModel());
    Grid<CostGrid::Weight> weights = made.weights();
    auto map = costsOf(weights);
    WeightedJumpPoint planner(options);
    planner.prepare(map, StopToken());
    for (int edit = 0; edit < 6; ++edit) {
      if (random() % 3 != 0) planner.finishBackgroundWork(StopToken());
      const Cell start = test::randomCell(random, geometry);
      if (map->passable(start)) expectLeastFrom(planner, *map, start, random, by_jumps);
      EXPECT_FALSE(testing::Test::HasFatalFailure()) << "map " << i << ", edit " << edit;
      if (testing::Test::HasFatalFailure()) return by_jumps;
      const auto changed = change(weights, random);
      map = costsOf(weights, {}, map->revision() + 1);
      planner.update(map, changed, StopToken());
    }
  }
  return by_jumps;
}

TEST(LandmarkJumps, LeastCostsOnRandomMapsWhileTheyChange) {
  EXPECT_GT(expectLeastWhileMapsChange(withLandmarks(), 40), 500U);
}

TEST(LandmarkJumps, ExpandFarFewerCells) {
  const auto map = costsOf(slopesBetweenWalls());
  WeightedJumpPoint plain, bounded(withLandmarks());
  for (WeightedJumpPoint* planner : {&plain, &bounded}) {
    planner->prepare(map, StopToken());
    planner->finishBackgroundWork(StopToken());
  }
  const SearchResult without = plain.search(kFarAcross, StopToken());
  const SearchResult with = bounded.search(kFarAcross, StopToken());
  EXPECT_EQ(with.answered_by, "weighted_jump_point");
  EXPECT_EQ(with.cost, without.cost);
  EXPECT_LT(3 * with.statistics.expanded, without.statistics.expanded);
  EXPECT_GT(with.statistics.search_bytes,
            without.statistics.search_bytes + 50 * map->geometry().size());
}

// A* with the same tables until the jumps are there, and no jumps where memory holds no more than it.
TEST(LandmarkJumps, AStarAnswersUntilThereIsIdleTimeAndWhereMemoryIsLittle) {
  const auto map = costsOf(slopesBetweenWalls());
  WeightedJumpPoint planner(withLandmarks());
  planner.prepare(map, StopToken());
  const SearchResult first = planner.search(kFarAcross, StopToken());
  EXPECT_EQ(first.answered_by, "a_star");
  WeightedJumpPoint limited(withLandmarks());
  const std::size_t of_one = limited.bytesFor(map->geometry());
  limited.limitMemory(of_one);
  limited.prepare(map, StopToken());
  limited.finishBackgroundWork(StopToken());
  const SearchResult second = limited.search(kFarAcross, StopToken());
  EXPECT_EQ(second.answered_by, "a_star");
  EXPECT_EQ(second.cost, first.cost);
  EXPECT_LE(limited.bytesFor(map->geometry()), of_one);
}

TEST(LandmarkJumps, NotOnMapsOfOneWeight) {
  auto weights = slopesBetweenWalls();
  for (auto& weight : weights.values()) weight = std::min<CostGrid::Weight>(weight, 1);
  auto map = costsOf(weights);
  WeightedJumpPoint planner(withLandmarks());
  planner.prepare(map, StopToken());
  planner.finishBackgroundWork(StopToken());
  EXPECT_EQ(planner.search(kFarAcross, StopToken()).answered_by, "a_star");
  // It becomes one of several.
  weights = slopesBetweenWalls();
  map = costsOf(weights, {}, map->revision() + 1);
  planner.update(map, {CellRect{0, 0, 640, 640}}, StopToken());
  planner.finishBackgroundWork(StopToken());
  const SearchResult result = planner.search(kFarAcross, StopToken());
  EXPECT_EQ(result.answered_by, "weighted_jump_point");
  EXPECT_EQ(result.cost, test::referenceCosts(*map, {5, 5})[630 * 640 + 630]);
}

TEST(LandmarkJumps, ATableThatKnowsOfNoPathSaysSo) {
  auto weights = slopesBetweenWalls();
  for (int column = 0; column < 640; ++column) weights[Cell{column, 320}] = CostGrid::kBlocked;
  WeightedJumpPoint planner(withLandmarks());
  planner.prepare(costsOf(weights), StopToken());
  planner.finishBackgroundWork(StopToken());
  const SearchResult result = planner.search(kFarAcross, StopToken());
  EXPECT_EQ(result.status, Status::UNREACHABLE);
  EXPECT_EQ(result.answered_by, "weighted_jump_point");
  EXPECT_EQ(result.statistics.expanded, 0U);
}

// Plans with idle time after each, until tables bound them. Returns how many went before; 0: none was bounded.
int plansUntilBounded(WeightedJumpPoint& planner, std::size_t plain, int most,
                      const SearchRequest& request = kFarAcross) {
  for (int plans = 1; plans <= most; ++plans) {
    planner.finishBackgroundWork(StopToken());
    const SearchResult result = planner.search(request, StopToken());
    if (3 * result.statistics.expanded < plain) return plans;
    EXPECT_EQ(result.statistics.expanded, plain) << "plan " << plans;
  }
  return 0;
}

std::size_t expandedAfterPreparation(const std::shared_ptr<const CostGrid>& map,
                                     const SearchRequest& request = kFarAcross) {
  WeightedJumpPoint planner;
  planner.prepare(map, StopToken());
  planner.finishBackgroundWork(StopToken());
  return planner.search(request, StopToken()).statistics.expanded;
}

// 16 tables take 32 searches of the passable cells, by which an expansion of the jumps counts as 8.
TEST(PaidLandmarks, AreMadeOnceSearchesHaveCostAsMuch) {
  const auto map = costsOf(slopesBetweenWalls());
  const std::size_t plain = expandedAfterPreparation(map);
  const auto& weights = map->weights().values();
  const auto blocked = std::count(weights.begin(), weights.end(), CostGrid::kBlocked);
  const std::size_t least = 32 * (weights.size() - static_cast<std::size_t>(blocked)) / (8 * plain);
  WeightedJumpPoint planner;
  planner.prepare(map, StopToken());
  const int plans = plansUntilBounded(planner, plain, 2 * static_cast<int>(least) + 10);
  EXPECT_GE(plans, static_cast<int>(least));
  EXPECT_LE(plans, static_cast<int>(least) + 3);
  EXPECT_GT(planner.bytesFor(map->geometry()), 64 * map->geometry().size());
  EXPECT_EQ(planner.search(kFarAcross, StopToken()).answered_by, "weighted_jump_point");
}

AStarOptions withFewLandmarks() {
  AStarOptions options;
  options.landmarks = 4;
  return options;
}

// Beside a planner without, whose costs are equal and which holds less.
TEST(PaidLandmarks, LeastCostsOnRandomMapsWhileTheyChange) {
  std::mt19937 random(41);
  int bounded = 0, bounded_after_change = 0;
  AStarOptions none;
  none.landmarks = 0;
  for (int i = 0; i < 30; ++i) {
    const GridGeometry geometry(40 + static_cast<int>(random() % 40), 60, 1.0);
    Grid<CostGrid::Weight> weights =
        test::randomPotential(random, geometry, MotionModel()).weights();
    auto map = costsOf(weights);
    WeightedJumpPoint planner(withFewLandmarks()), plain(none);
    for (WeightedJumpPoint* each : {&planner, &plain}) each->prepare(map, StopToken());
    bool changed_since = false;
    for (int query = 0; query < 400; ++query) {
      for (WeightedJumpPoint* each : {&planner, &plain}) each->finishBackgroundWork(StopToken());
      const SearchRequest request{
          test::randomCell(random, geometry), {test::randomCell(random, geometry)}, false};
      const SearchResult with = planner.search(request, StopToken());
      const SearchResult without = plain.search(request, StopToken());
      ASSERT_EQ(with.status, without.status) << "map " << i << ", query " << query;
      ASSERT_EQ(with.cost, without.cost) << "map " << i << ", query " << query;
      const bool held =
          planner.bytesFor(geometry) > plain.bytesFor(geometry) + 16 * geometry.size();
      changed_since = changed_since && held;
      const bool by_them = held && with.answered_by == "weighted_jump_point";
      bounded += by_them;
      bounded_after_change += by_them && changed_since;
      if (query % 50 != 49) continue;
      const Cell cell = test::randomCell(random, geometry);
      weights[cell] = query % 100 == 49 ? CostGrid::kBlocked : CostGrid::Weight(1);
      map = costsOf(weights, {}, map->revision() + 1);
      for (WeightedJumpPoint* each : {&planner, &plain})
        each->update(map, {CellRect{cell.column, cell.row, 1, 1}}, StopToken());
      changed_since = true;
    }
  }
  EXPECT_GT(bounded, 2000);
  EXPECT_GT(bounded_after_change, 1000);
}

TEST(PaidLandmarks, NoneWithoutIdleTimeOrWhereNoneAreAllowed) {
  const auto map = costsOf(slopesBetweenWalls());
  const std::size_t plain = expandedAfterPreparation(map);
  WeightedJumpPoint busy(withFewLandmarks());
  busy.prepare(map, StopToken());
  busy.finishBackgroundWork(StopToken());
  for (int plans = 0; plans < 100; ++plans)
    ASSERT_EQ(busy.search(kFarAcross, StopToken()).statistics.expanded, plain);
  AStarOptions none;
  none.landmarks = 0;
  WeightedJumpPoint without(none);
  without.prepare(map, StopToken());
  EXPECT_EQ(plansUntilBounded(without, plain, 200), 0);
}

TEST(PaidLandmarks, NoneWhereMemoryIsLittle) {
  const auto map = costsOf(slopesBetweenWalls());
  const std::size_t plain = expandedAfterPreparation(map);
  WeightedJumpPoint planner(withFewLandmarks());
  const std::size_t before = planner.bytesFor(map->geometry());
  planner.limitMemory(before + 20 * map->geometry().size());
  planner.prepare(map, StopToken());
  EXPECT_EQ(plansUntilBounded(planner, plain, 200), 0);
  // And they go where it becomes little.
  planner.limitMemory(std::numeric_limits<std::size_t>::max());
  EXPECT_GT(plansUntilBounded(planner, plain, 200), 0);
  planner.limitMemory(before);
  EXPECT_EQ(planner.search(kFarAcross, StopToken()).statistics.expanded, plain);
  EXPECT_LE(planner.bytesFor(map->geometry()), before);
}

// Costlier cells leave bounds true; after many cheaper ones, all over the map, searches pay for others.
TEST(PaidLandmarks, StayWhileTheMapChangesALittleAndGoWithMuchOfIt) {
  auto weights = slopesBetweenWalls();
  auto map = costsOf(weights);
  WeightedJumpPoint planner(withFewLandmarks());
  planner.prepare(map, StopToken());
  ASSERT_GT(plansUntilBounded(planner, expandedAfterPreparation(map), 200), 0);
  weights[Cell{320, 330}] = CostGrid::kBlocked;
  map = costsOf(weights, {}, map->revision() + 1);
  planner.update(map, {CellRect{320, 330, 1, 1}}, StopToken());
  planner.finishBackgroundWork(StopToken());
  const std::size_t plain = expandedAfterPreparation(map);
  EXPECT_LT(3 * planner.search(kFarAcross, StopToken()).statistics.expanded, plain);

  for (auto& weight : weights.values())
    if (weight != CostGrid::kBlocked) weight = std::max<CostGrid::Weight>(1, weight - 1);
  map = costsOf(weights, {}, map->revision() + 1);
  planner.update(map, {map->geometry().rect()}, StopToken());
  planner.finishBackgroundWork(StopToken());
  const SearchRequest elsewhere{{5, 5}, {{600, 615}}, false};  // of which no tree is kept
  const std::size_t anew = expandedAfterPreparation(map, elsewhere);
  EXPECT_EQ(planner.search(elsewhere, StopToken()).statistics.expanded, anew);
  EXPECT_LT(planner.bytesFor(map->geometry()), 40 * map->geometry().size());
  EXPECT_GT(plansUntilBounded(planner, anew, 200, elsewhere), 0);
}

}  // namespace
}  // namespace grid_path_planner::planners
