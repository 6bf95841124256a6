// Which bound searches use: what rows tell, what searches tell, and that costs stay the least.
#include "planners/astar/bound_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <random>

#include "planners/astar/a_star.h"
#include "planners/jump_point/weighted_jump_point.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planners {
namespace {

using base::Status, base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::CellRect, grid::Grid, grid::GridGeometry;
using test::costMap, test::costsOf;

constexpr BoundPrices kPrices{1.5, 0.5, 1000, 1};

// Slopes between walls from top to bottom, `thick` cells each, 30 apart, with doors in turn at both ends.
Grid<CostGrid::Weight> roomsBetweenWalls(int side, int thick) {
  Grid<CostGrid::Weight> weights(GridGeometry(side, side, 1.0), 1);
  const int period = 30 + thick;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const int in_room = column % period - thick;
      const bool door = (column / period % 2 == 0 ? row : side - 1 - row) < 6;
      const int from_wall = std::min(in_room, 30 - in_room);
      weights[Cell{column, row}] = in_room < 0 && !door
                                       ? CostGrid::kBlocked
                                       : static_cast<CostGrid::Weight>(std::max(20 - from_wall, 4));
    }
  weights[Cell{thick, 0}] = 1;
  return weights;
}

BoundChoice choiceFor(const CostGrid& map) {
  BoundChoice choice(kPrices);
  choice.prepare(map);
  return choice;
}

TEST(BoundChoice, RowsDecideForTheBlocksWhereCostsAreHighAndWallsThick) {
  const BoundChoice thick = choiceFor(costMap(roomsBetweenWalls(200, 12)));
  EXPECT_FALSE(thick.undecided());
  EXPECT_TRUE(thick.blocks());
  const BoundChoice thin = choiceFor(costMap(roomsBetweenWalls(200, 2)));
  EXPECT_TRUE(thin.undecided());
  EXPECT_FALSE(thin.blocks());
  Grid<CostGrid::Weight> flat(GridGeometry(200, 200, 1.0), 4);
  flat[Cell{7, 7}] = 5;
  EXPECT_TRUE(choiceFor(costMap(flat)).undecided());
}

TEST(BoundChoice, SearchesDecideByWhatTheBoundWouldHaveSpared) {
  const CostGrid map = costMap(roomsBetweenWalls(200, 2));
  BoundChoice spared = choiceFor(map), wasted = choiceFor(map), costly = choiceFor(map);
  spared.learn({900, 0.7, 200});
  EXPECT_TRUE(spared.undecided());
  EXPECT_FALSE(spared.blocks());
  spared.learn({200, 0.7, 50});
  EXPECT_FALSE(spared.undecided());
  EXPECT_TRUE(spared.blocks());
  wasted.learn({1100, 0.1, 250});
  EXPECT_FALSE(wasted.undecided());
  EXPECT_FALSE(wasted.blocks());
  costly.learn({1100, 0.7, 2000});
  EXPECT_FALSE(costly.blocks());
}

// Two searches of the jumps, of which the first was not like those that followed, decided for blocks that made
// plans in offices 1.5 times as long.
TEST(BoundChoice, AFewSearchesDecideOnlyWhereTheyWereLong) {
  constexpr BoundPrices kOfThree{1.5, 0.5, 1000, 3};
  const CostGrid map = costMap(roomsBetweenWalls(100, 2));
  BoundChoice mixed(kOfThree);
  mixed.prepare(map);
  mixed.learn({1100, 0.9, 0});
  mixed.learn({1100, 0.1, 400});
  EXPECT_TRUE(mixed.undecided());
  EXPECT_FALSE(mixed.blocks());
  mixed.learn({1100, 0.1, 400});
  EXPECT_FALSE(mixed.undecided());
  EXPECT_FALSE(mixed.blocks());
  BoundChoice long_one(kOfThree);
  long_one.prepare(map);
  long_one.learn({4000, 0.9, 100});
  EXPECT_TRUE(long_one.blocks());
}

TEST(BoundChoice, StaysUntilAnEighthOfTheMapChanged) {
  const CostGrid map = costMap(roomsBetweenWalls(200, 2));
  BoundChoice choice = choiceFor(map);
  choice.learn({1100, 0.9, 0});
  ASSERT_TRUE(choice.blocks());
  // A place that the vehicle looks at again and again counts once: 13×2 blocks.
  for (int edit = 0; edit < 20; ++edit) choice.update(map, {CellRect{0, 0, 100, 10}});
  EXPECT_TRUE(choice.blocks());
  choice.update(map, {CellRect{0, 40, 100, 10}, CellRect{0, 80, 100, 10}});
  EXPECT_TRUE(choice.blocks());
  choice.update(map, {CellRect{199, 199, 1, 1}});
  EXPECT_TRUE(choice.undecided());
  EXPECT_FALSE(choice.blocks());
}

TEST(BoundChoice, LearnsNothingFromASearchOfTheMapBefore) {
  const auto map = costsOf(roomsBetweenWalls(400, 2));
  BoundChoice choice({1.4, 0.8, 1, 0});
  choice.prepare(*map);
  AStarOptions options;
  options.heuristic = Heuristic::BLOCKS;
  AStar a_star(options, choice);
  a_star.prepare(map, StopToken());
  const SearchRequest across{{10, 200}, {{390, 200}}, false};
  a_star.search(across, StopToken());
  const auto next = costsOf(map->weights(), {}, map->revision() + 1);
  a_star.update(next, {CellRect{0, 0, 1, 1}}, StopToken());
  a_star.search(across, StopToken());
  EXPECT_TRUE(choice.undecided());
  a_star.search(across, StopToken());
  EXPECT_FALSE(choice.undecided());
}

// A map with the same weights and nothing changed took the place of the one before, which the jumps asked all the
// same, for the size of what had been freed. Here it was 0.
TEST(BoundChoice, TheJumpsLearnFromASearchOfAMapThatIsGone) {
  alignas(CostGrid) std::array<unsigned char, sizeof(CostGrid)> place;
  const Grid<CostGrid::Weight> weights = roomsBetweenWalls(500, 2);
  std::shared_ptr<const CostGrid> first(new (place.data()) CostGrid(test::costMap(weights)),
                                        [&place](const CostGrid* map) {
                                          map->~CostGrid();
                                          place.fill(0);
                                        });
  WeightedJumpPoint planner;
  planner.prepare(first, StopToken());
  planner.finishBackgroundWork(StopToken());
  const SearchRequest across{{4, 100}, {{495, 493}}, false};
  const SearchResult before = planner.search(across, StopToken());
  EXPECT_EQ(before.answered_by, "weighted_jump_point");
  const auto second = costsOf(weights, {}, first->revision() + 1);
  first.reset();
  planner.update(second, {}, StopToken());
  EXPECT_EQ(planner.search(across, StopToken()).cost, before.cost);
}

// Of one weight the options ask for no blocks: nothing is made of them in order to learn.
TEST(BoundChoice, LearnsNothingOfAMapOfOneWeight) {
  Grid<CostGrid::Weight> weights = roomsBetweenWalls(400, 2);
  for (CostGrid::Weight& weight : weights.values()) weight = std::min<CostGrid::Weight>(weight, 1);
  const auto map = costsOf(weights);
  BoundChoice choice({1.4, 0.8, 1, 0});
  choice.prepare(*map);
  AStar by_choice(AStarOptions(), choice), alone;
  by_choice.prepare(map, StopToken());
  alone.prepare(map, StopToken());
  const SearchRequest across{{10, 200}, {{390, 200}}, false};
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(by_choice.search(across, StopToken()).statistics.search_bytes,
              alone.search(across, StopToken()).statistics.search_bytes);
  EXPECT_TRUE(choice.undecided());
}

// A user plans across an office. Its walls are thinner than a block, so the bound of the blocks sees through
// them: it took longer than the octile distance, from the first plan on and for ever.
TEST(BoundChoice, ThinWallsEndWithTheOctileDistance) {
  const auto map = costsOf(roomsBetweenWalls(400, 2));
  BoundChoice choice(kPricesOfAStar);
  choice.prepare(*map);
  AStarOptions options;
  options.heuristic = Heuristic::BLOCKS;
  AStar by_choice(options, choice), by_octile;
  by_choice.prepare(map, StopToken());
  by_octile.prepare(map, StopToken());
  const SearchRequest across{{10, 200}, {{390, 200}}, false};
  const SearchResult least = by_octile.search(across, StopToken());
  for (int i = 0; i < 5; ++i) {
    const SearchResult result = by_choice.search(across, StopToken());
    EXPECT_EQ(result.cost, least.cost);
    EXPECT_EQ(result.statistics.expanded, least.statistics.expanded);
  }
  EXPECT_FALSE(choice.undecided());
  EXPECT_FALSE(choice.blocks());
}

// Islands are thin, too, but a path goes around them: there the blocks spare most of the search.
TEST(BoundChoice, ThinIslandsEndWithTheBlocks) {
  Grid<CostGrid::Weight> weights(GridGeometry(400, 400, 1.0), 12);
  for (int row = 20; row < 400; row += 20)
    for (int column = 20; column < 400; column += 20)
      for (int i = 0; i < 3; ++i)
        weights[Cell{column + i, row}] = weights[Cell{column, row + i}] = 0;
  for (int column = 0; column < 400; ++column) weights[Cell{column, 0}] = 1;
  const auto map = costsOf(weights);
  BoundChoice choice(kPricesOfAStar);
  choice.prepare(*map);
  EXPECT_TRUE(choice.undecided());
  AStarOptions options;
  options.heuristic = Heuristic::BLOCKS;
  AStar by_choice(options, choice);
  by_choice.prepare(map, StopToken());
  const SearchRequest across{{10, 390}, {{390, 200}}, false};
  const SearchResult first = by_choice.search(across, StopToken());
  SearchResult last = first;
  for (int i = 0; i < 5; ++i) last = by_choice.search(across, StopToken());
  EXPECT_TRUE(choice.blocks());
  EXPECT_EQ(last.cost, first.cost);
  EXPECT_LT(2 * last.statistics.expanded, first.statistics.expanded);
}

// Whatever was decided meanwhile, in every motion model, also after edits.
TEST(BoundChoiceLaw, CostsAreTheLeast) {
  std::mt19937 random(20261126);
  int found = 0, decided_by_searches = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const costmap::MotionModel motion{
        trial % 4 == 3 ? costmap::Connectivity::FOUR : costmap::Connectivity::EIGHT,
        trial % 4 == 2 ? costmap::DiagonalCost::UNIT : costmap::DiagonalCost::SQRT2,
        trial % 3 == 0};
    Grid<CostGrid::Weight> weights = roomsBetweenWalls(120 + int(random() % 60), 1 + trial % 9);
    BoundChoice choice({1.4, 0.8, trial % 2 == 0 ? 5000U : 20000U, 0});
    auto map = costsOf(weights, motion);
    choice.prepare(*map);
    const bool at_once = !choice.undecided();
    AStarOptions options;
    options.heuristic = Heuristic::BLOCKS;
    AStar a_star(options, choice);
    WeightedJumpPoint jumps;
    a_star.prepare(map, StopToken());
    jumps.prepare(map, StopToken());
    if (trial % 2 == 0) jumps.finishBackgroundWork(StopToken());
    for (int i = 0; i < 12; ++i) {
      const Cell start = test::randomCell(random, map->geometry());
      const Cell goal = test::randomCell(random, map->geometry());
      if (!map->passable(start) || !map->passable(goal)) continue;
      const auto least = test::referenceCosts(*map, goal)[map->geometry().index(start).value()];
      for (Planner* planner : {static_cast<Planner*>(&a_star), static_cast<Planner*>(&jumps)}) {
        const SearchResult result = planner->search({start, {goal}, false}, StopToken());
        ASSERT_EQ(result.status == Status::FOUND, least.has_value()) << "trial " << trial;
        if (!least) continue;
        ASSERT_EQ(result.cost, *least) << "trial " << trial;
        ++found;
      }
      if (i % 3 != 2) continue;
      const CellRect changed =
          CellRect{goal.column + 2, goal.row + 2, 9, 9}.intersection(map->geometry().rect());
      for (int row = changed.row; row < changed.row + changed.height; ++row)
        for (int at = 0; at < changed.width; ++at)
          weights[Cell{changed.column + at, row}] = static_cast<CostGrid::Weight>(random() % 30);
      map = costsOf(weights, motion, map->revision() + 1);
      choice.update(*map, {changed});
      a_star.update(map, {changed}, StopToken());
      jumps.update(map, {changed}, StopToken());
    }
    decided_by_searches += !at_once && !choice.undecided();
  }
  EXPECT_GT(found, 150);
  EXPECT_GT(decided_by_searches, 4);
}

}  // namespace
}  // namespace grid_path_planner::planners
