#include "planners/jump_point/weighted_jump_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "planners/astar/a_star.h"
#include "planners/jump_point/walls.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planners {

using base::Status;
using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::DiagonalCost;
using costmap::ExactCost;
using costmap::MotionModel;
using grid::Cell;
using grid::CellIndex;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using test::costsOf;

namespace {

void expectLeast(WeightedJumpPoint& planner, const CostGrid& map, std::mt19937& random,
                 int queries) {
  const Cell start = test::randomCell(random, map.geometry());
  if (!map.passable(start)) return;
  const auto costs = test::referenceCosts(map, start);
  for (int query = 0; query < queries; ++query) {
    const Cell goal = test::randomCell(random, map.geometry());
    if (!map.passable(goal)) continue;
    const SearchResult result = planner.search({start, {goal}, false}, StopToken());
    const auto least = costs[map.geometry().index(goal).value()];
    ASSERT_EQ(result.status, least ? Status::FOUND : Status::UNREACHABLE);
    if (least) {
      ASSERT_EQ(result.cost, *least) << start << " to " << goal;
    }
  }
}

Grid<CostGrid::Weight> noise(std::mt19937& random, int side) {
  Grid<CostGrid::Weight> weights(GridGeometry(side, side, 1.0), 1);
  for (auto& weight : weights.values()) weight = static_cast<CostGrid::Weight>(1 + random() % 99);
  return weights;
}

TEST(PruningEstimate, TellsPlateausAndSlopesFromNoise) {
  std::mt19937 random(2);
  PruningEstimate estimate;
  Grid<CostGrid::Weight> weights(GridGeometry(200, 150, 1.0), 1);
  estimate.sample(*costsOf(weights), StopToken());
  EXPECT_TRUE(estimate.jumpingPays());
  for (std::uint32_t i = 0; i < weights.values().size(); ++i)
    weights[CellIndex(i)] = static_cast<CostGrid::Weight>(1 + i % 200 / 3);
  estimate.sample(*costsOf(weights), StopToken());
  EXPECT_TRUE(estimate.jumpingPays());
  estimate.sample(*costsOf(noise(random, 200)), StopToken());
  EXPECT_FALSE(estimate.jumpingPays());
}

// Each search counts its own kind of cells: noise is expanded cell by cell.
TEST(WeightedJumpPoint, AnswersNoiseByAStarAndPlateausByJumps) {
  std::mt19937 random(3);
  WeightedJumpPoint planner;
  AStarOptions options;
  options.heuristic = Heuristic::BLOCKS;
  AStar a_star(options);
  const SearchRequest request{{3, 3}, {{90, 80}}, false};
  auto map = costsOf(noise(random, 100));
  planner.prepare(map, StopToken());
  a_star.prepare(map, StopToken());
  const SearchResult in_noise = planner.search(request, StopToken());
  EXPECT_EQ(in_noise.statistics.expanded, a_star.search(request, StopToken()).statistics.expanded);
  EXPECT_EQ(in_noise.answered_by, "a_star");
  map = costsOf(Grid<CostGrid::Weight>(map->geometry(), 5), {}, 1);
  planner.update(map, {map->geometry().rect()}, StopToken());
  EXPECT_FALSE(planner.backgroundWork().pending);
  EXPECT_EQ(planner.search(request, StopToken()).answered_by, "jump_point");
}

// Walls with a gap every tenth cell, two free rows between them: one free cell in five and more is a jump point.
Grid<CostGrid::Weight> narrowPassages(int width, int height) {
  Grid<CostGrid::Weight> weights(GridGeometry(width, height, 1.0), 1);
  for (int row = 1; row < height; row += 3)
    for (int column = 0; column < width; ++column)
      if ((column + row) % 10 != 0) weights[Cell{column, row}] = CostGrid::kBlocked;
  return weights;
}

TEST(WeightedJumpPoint, PreparesJumpsInNarrowPassagesOfOneWeight) {
  const auto map = costsOf(narrowPassages(300, 200));
  WeightedJumpPoint planner;
  planner.prepare(map, StopToken());
  const SearchRequest request{{3, 3}, {{290, 180}}, false};
  const SearchResult first = planner.search(request, StopToken());
  EXPECT_EQ(first.answered_by, "jump_point");
  EXPECT_TRUE(planner.backgroundWork().pending);
  planner.finishBackgroundWork(StopToken());
  EXPECT_FALSE(planner.backgroundWork().pending);
  const SearchResult prepared = planner.search(request, StopToken());
  EXPECT_EQ(prepared.answered_by, "weighted_jump_point");
  EXPECT_EQ(prepared.cost, first.cost);
}

TEST(WeightedJumpPoint, AnswersNoiseOfOneWeightByAStar) {
  std::mt19937 random(9);
  Grid<CostGrid::Weight> weights(GridGeometry(200, 150, 1.0), 4);
  for (auto& weight : weights.values())
    if (random() % 10 == 0) weight = CostGrid::kBlocked;
  weights[Cell{3, 3}] = weights[Cell{190, 140}] = 4;
  WeightedJumpPoint planner;
  planner.prepare(costsOf(weights), StopToken());
  planner.finishBackgroundWork(StopToken());
  const SearchResult result = planner.search({{3, 3}, {{190, 140}}, false}, StopToken());
  EXPECT_EQ(result.status, Status::FOUND);
  EXPECT_EQ(result.answered_by, "a_star");
}

TEST(WeightedJumpPointLaw, FindsTheLeastCostInEveryMotionModel) {
  std::mt19937 random(20261121);
  for (int trial = 0; trial < 1200; ++trial) {
    const MotionModel motion{trial % 2 == 0 ? Connectivity::EIGHT : Connectivity::FOUR,
                             trial / 2 % 2 == 0 ? DiagonalCost::SQRT2 : DiagonalCost::UNIT,
                             trial / 4 % 2 == 0};
    const auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 20, motion));
    WeightedJumpPoint planner;
    planner.prepare(map, StopToken());
    expectLeast(planner, *map, random, 6);
    if (HasFatalFailure()) FAIL() << "trial " << trial;
  }
}

SearchRequest randomRequest(std::mt19937& random, const CostGrid& map) {
  return {
      test::randomCell(random, map.geometry()), {test::randomCell(random, map.geometry())}, true};
}

// Three planners of one map: one that has prepared nothing, one as earlier questions left it (some
// of them stopped before their end) and one that has prepared everything. The cost is the same; the
// cells and what was expanded too, but on maps of one weight, where JumpPoint answers first.
void expectAlikeInEveryState(std::mt19937& random, WeightedJumpPoint& asked,
                             WeightedJumpPoint& done, const std::shared_ptr<const CostGrid>& map,
                             int queries) {
  done.finishBackgroundWork(StopToken());
  EXPECT_FALSE(done.backgroundWork().pending);
  for (int query = 0; query < queries; ++query) {
    WeightedJumpPoint fresh;
    fresh.prepare(map, StopToken());
    const SearchRequest request = randomRequest(random, *map);
    const auto soon = std::chrono::duration<double>(20e-6 * (query % 8));
    if (query % 2 == 0) asked.search(randomRequest(random, *map), base::StopSource().token(soon));
    const SearchResult a = fresh.search(request, StopToken());
    const SearchResult b = asked.search(request, StopToken());
    const SearchResult c = done.search(request, StopToken());
    ASSERT_EQ(a.status, c.status);
    ASSERT_EQ(b.status, c.status);
    ASSERT_EQ(a.cost, c.cost);
    ASSERT_EQ(b.cost, c.cost);
    if (map->uniform()) continue;
    ASSERT_EQ(a.cells, c.cells);
    ASSERT_EQ(b.cells, c.cells);
    ASSERT_EQ(a.expanded, c.expanded);
    ASSERT_EQ(b.expanded, c.expanded);
  }
}

// 1,020 queries before, during and after preparation.
TEST(WeightedJumpPointLaw, PreparationChangesNoAnswer) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 34; ++trial) {
    Grid<CostGrid::Weight> weights =
        test::randomCosts(random, GridGeometry(130, 70, 1.0), {}).weights();
    auto map = costsOf(weights);
    WeightedJumpPoint asked, done;
    asked.prepare(map, StopToken());
    done.prepare(map, StopToken());
    for (int edit = 0; edit < 3; ++edit) {
      expectAlikeInEveryState(random, asked, done, map, 10);
      if (::testing::Test::HasFatalFailure()) FAIL() << "trial " << trial << ", edit " << edit;
      const Cell low = test::randomCell(random, map->geometry());
      const int longest = edit == 0 ? 4 : 90;
      const CellRect changed =
          CellRect{low.column, low.row, 1 + int(random() % longest), 1 + int(random() % longest)}
              .intersection(map->geometry().rect());
      for (int row = changed.row; row < changed.row + changed.height; ++row)
        for (int column = changed.column; column < changed.column + changed.width; ++column)
          weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 3);
      map = costsOf(weights, {}, map->revision() + 1);
      asked.update(map, {changed}, StopToken());
      done.update(map, {changed}, StopToken());
    }
  }
}

std::vector<CellRect> randomRects(std::mt19937& random, const GridGeometry& geometry, int most) {
  std::vector<CellRect> rects;
  for (int i = 0; i < 1 + int(random() % most); ++i) {
    const Cell low = test::randomCell(random, geometry);
    rects.push_back(
        CellRect{low.column, low.row, 1 + int(random() % 60), 1 + int(random() % 60)}.intersection(
            geometry.rect()));
  }
  return grid::disjointRects(rects);
}

void fill(Grid<CostGrid::Weight>& weights, const std::vector<CellRect>& rects,
          std::mt19937& random) {
  for (const CellRect& rect : rects) {
    const auto weight = static_cast<CostGrid::Weight>(random() % 4);
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      std::fill_n(weights.row(row) + rect.column, rect.width, weight);
  }
}

// On maps of more tiles than one search may make, A* answers until the jumps are prepared.
TEST(WeightedJumpPointLaw, CostsAreLeastWhicheverSearchAnswers) {
  std::mt19937 random(7);
  std::map<std::string, int> answers;
  for (int trial = 0; trial < 3; ++trial) {
    Grid<CostGrid::Weight> weights(GridGeometry(900, 500 + trial, 1.0), 1);
    fill(weights, randomRects(random, weights.geometry(), 150), random);
    auto map = costsOf(weights);
    WeightedJumpPoint planner;
    planner.prepare(map, StopToken());
    for (int edit = 0; edit < 3; ++edit) {
      if (edit == 1) planner.finishBackgroundWork(StopToken());
      const SearchRequest across{{0, 0}, {{899, 499}}, false};
      if (map->passable({0, 0}) && map->passable({899, 499}))
        ++answers[planner.search(across, StopToken()).answered_by];
      expectLeast(planner, *map, random, 8);
      if (::testing::Test::HasFatalFailure()) FAIL() << "trial " << trial << ", edit " << edit;
      const std::vector<CellRect> changed = randomRects(random, weights.geometry(), 12);
      fill(weights, changed, random);
      map = costsOf(weights, {}, map->revision() + 1);
      planner.update(map, changed, StopToken());
    }
  }
  EXPECT_GT(answers["a_star"], 0);
  EXPECT_GT(answers["weighted_jump_point"], 0);
}

// Edits make a map of one weight one of several, and noise, and back, before and after preparation.
// What is blocked is noise, too: A* answers there, and the jumps where it is dense.
TEST(WeightedJumpPointLaw, CostsAreLeastWhileMapsBecomeOfOneWeightAndBack) {
  std::mt19937 random(8);
  std::map<std::string, int> answers;
  for (int trial = 0; trial < 6; ++trial) {
    Grid<CostGrid::Weight> weights(GridGeometry(300, 150 + trial, 1.0), 3);
    auto map = costsOf(weights);
    WeightedJumpPoint planner;
    planner.prepare(map, StopToken());
    for (int edit = 0; edit < 10; ++edit) {
      const unsigned values = 1 + random() % 3;  // one weight, several, noise
      const unsigned one_in = std::array<unsigned, 3>{3, 10, 300}[random() % 3];  // is blocked
      for (auto& weight : weights.values())
        weight = values == 3 ? static_cast<CostGrid::Weight>(1 + random() % 99)
                             : static_cast<CostGrid::Weight>(random() % one_in == 0 ? 0 : 3);
      if (values == 2) std::fill_n(weights.row(7), 200, CostGrid::Weight{9});
      map = costsOf(weights, {}, map->revision() + 1);
      planner.update(map, {map->geometry().rect()}, StopToken());
      if (random() % 3 == 0) planner.finishBackgroundWork(StopToken());
      const SearchRequest request = randomRequest(random, *map);
      ++answers[planner.search(request, StopToken()).answered_by];
      expectLeast(planner, *map, random, 6);
      if (::testing::Test::HasFatalFailure()) FAIL() << "trial " << trial << ", edit " << edit;
    }
  }
  for (const char* name : {"a_star", "jump_point", "weighted_jump_point"})
    EXPECT_GT(answers[name], 0) << name;
}

// Where memory is for one of both searches the substitute goes first, and a preparation that is stopped leaves none.
TEST(WeightedJumpPoint, AnswersAfterAStoppedPreparationWithoutMemoryForBoth) {
  const auto map = costsOf(narrowPassages(300, 200));
  WeightedJumpPoint planner;
  planner.limitMemory(planner.bytesFor(map->geometry()));
  planner.prepare(map, StopToken());
  base::StopSource stopped;
  stopped.cancel();
  EXPECT_THROW(planner.finishBackgroundWork(stopped.token()), base::Stopped);
  const SearchRequest request{{3, 3}, {{290, 180}}, false};
  const SearchResult result = planner.search(request, StopToken());
  AStar a_star;
  a_star.prepare(map, StopToken());
  EXPECT_EQ(result.status, Status::FOUND);
  EXPECT_EQ(result.cost, a_star.search(request, StopToken()).cost);
}

// Who answers across the map once a square of this side in its middle is blocked but for its first
// row, after all was prepared.
std::string answersAfterEdit(int side) {
  Grid<CostGrid::Weight> weights = test::slopesBetweenWalls();
  WeightedJumpPoint planner;
  planner.prepare(costsOf(weights), StopToken());
  planner.finishBackgroundWork(StopToken());
  const CellRect changed{300, 300, side, side};
  for (int row = 301; row < 300 + side; ++row)
    std::fill_n(weights.row(row) + 300, side, CostGrid::kBlocked);
  const auto map = costsOf(weights, {}, 1);
  planner.update(map, {changed}, StopToken());
  AStar a_star;
  a_star.prepare(map, StopToken());
  const SearchRequest across{{5, 5}, {{630, 630}}, false};
  const SearchResult result = planner.search(across, StopToken());
  EXPECT_EQ(result.cost, a_star.search(across, StopToken()).cost);
  return result.answered_by;
}

TEST(WeightedJumpPoint, MakesAnewTheFewTilesThatAnEditUndid) {
  EXPECT_EQ(answersAfterEdit(70), "weighted_jump_point");
}

TEST(WeightedJumpPoint, LeavesWhatAnEditOfHalfTheMapUndidToAStar) {
  EXPECT_EQ(answersAfterEdit(330), "a_star");
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
          CellRect{low.column, low.row, 1 + int(random() % 12), 1 + int(random() % 12)}
              .intersection(map->geometry().rect());
      Grid<CostGrid::Weight> weights = map->weights();
      for (int row = changed.row; row < changed.row + changed.height; ++row)
        for (int column = changed.column; column < changed.column + changed.width; ++column)
          weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 5);
      map = costsOf(weights, {}, map->revision() + 1);
      edited.update(map, {changed}, StopToken());
      WeightedJumpPoint fresh;
      fresh.prepare(map, StopToken());
      for (int query = 0; query < 5; ++query) {
        const SearchRequest request{test::randomCell(random, map->geometry()),
                                    {test::randomCell(random, map->geometry())},
                                    true};
        const SearchResult a = edited.search(request, StopToken());
        const SearchResult b = fresh.search(request, StopToken());
        ASSERT_EQ(a.status, b.status);
        ASSERT_EQ(a.cells, b.cells);
        ASSERT_EQ(a.expanded, b.expanded);
      }
      expectLeast(edited, *map, random, 5);
      if (HasFatalFailure()) FAIL() << "trial " << trial;
    }
  }
}

TEST(WeightedJumpPoint, LeavesPathsOfHighCostToAStar) {
  const auto map = costsOf(Grid<CostGrid::Weight>(GridGeometry(400, 3, 1.0), 65535));
  WeightedJumpPoint planner;
  planner.prepare(map, StopToken());
  for (int query = 0; query < 2; ++query) {
    const SearchResult result = planner.search({{0, 0}, {{399, 2}}, false}, StopToken());
    EXPECT_EQ(result.cost, (ExactCost{397LL * 65535, 2LL * 65535}));
    const SearchResult near = planner.search({{0, 0}, {{99, 2}}, false}, StopToken());
    EXPECT_EQ(near.cost, (ExactCost{97LL * 65535, 2LL * 65535}));
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
