// Jumps that landmarks bound: least costs on any map and after any change, fewer expansions, and A* where jumps may not.
#include <gtest/gtest.h>

#include <algorithm>
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

// Tables are older than the map where nobody waits for new ones.
TEST(LandmarkJumps, LeastCostsOnRandomMapsWhileTheyChange) {
  std::mt19937 random(40);
  std::size_t by_jumps = 0;
  for (int i = 0; i < 60; ++i) {
    const GridGeometry geometry(20 + static_cast<int>(random() % 50),
                                20 + static_cast<int>(random() % 50), 1.0);
    const CostGrid made = i % 2 == 0 ? test::randomPotential(random, geometry, MotionModel())
                                     : test::randomCosts(random, geometry, MotionModel());
    Grid<CostGrid::Weight> weights = made.weights();
    auto map = costsOf(weights);
    WeightedJumpPoint planner(withLandmarks());
    planner.prepare(map, StopToken());
    for (int edit = 0; edit < 6; ++edit) {
      if (random() % 3 != 0) planner.finishBackgroundWork(StopToken());
      const Cell start = test::randomCell(random, geometry);
      if (map->passable(start)) expectLeastFrom(planner, *map, start, random, by_jumps);
      ASSERT_FALSE(HasFatalFailure()) << "map " << i << ", edit " << edit;
      const auto changed = change(weights, random);
      map = costsOf(weights, {}, map->revision() + 1);
      planner.update(map, changed, StopToken());
    }
  }
  EXPECT_GT(by_jumps, 500U);
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
}

}  // namespace
}  // namespace grid_path_planner::planners
