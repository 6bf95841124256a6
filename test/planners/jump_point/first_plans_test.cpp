// On a new map of several weights the default planner prepares nothing that its first plans do not need.
#include <gtest/gtest.h>

#include <random>

#include "planners/astar/a_star.h"
#include "planners/jump_point/walls.h"
#include "planners/jump_point/weighted_jump_point.h"
#include "support/cost_maps.h"

namespace grid_path_planner::planners {
namespace {

using base::Status, base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::Grid, grid::GridGeometry;
using test::costsOf, test::slopesBetweenWalls;

const SearchRequest kAcross{{5, 5}, {{630, 630}}, false};

TEST(FirstPlans, AStarAnswersUntilThereIsIdleTime) {
  WeightedJumpPoint planner;
  planner.prepare(costsOf(slopesBetweenWalls()), StopToken());
  EXPECT_TRUE(planner.backgroundWork().pending);
  const SearchResult first = planner.search(kAcross, StopToken());
  EXPECT_EQ(first.answered_by, "a_star");
  planner.finishBackgroundWork(StopToken());
  EXPECT_FALSE(planner.backgroundWork().pending);
  const SearchResult prepared = planner.search(kAcross, StopToken());
  EXPECT_EQ(prepared.answered_by, "weighted_jump_point");
  EXPECT_EQ(prepared.cost, first.cost);
}

// What A* expands pays for the jumps.
TEST(FirstPlans, ManyOfThemBringTheJumpsWithoutIdleTime) {
  WeightedJumpPoint planner;
  planner.prepare(costsOf(slopesBetweenWalls()), StopToken());
  const SearchResult first = planner.search(kAcross, StopToken());
  SearchResult last = first;
  for (int i = 0; i < 100 && last.answered_by == "a_star"; ++i) {
    last = planner.search(kAcross, StopToken());
    ASSERT_EQ(last.cost, first.cost);
  }
  EXPECT_EQ(last.answered_by, "weighted_jump_point");
}

// Ten plans do not win back a tile: at first one is for three quarters of a million expansions. This
// question comes to about ten tiles.
TEST(FirstPlans, AFewOfThemPayForNoJumps) {
  const SearchRequest near{{215, 215}, {{235, 230}}, false};
  WeightedJumpPoint planner;
  planner.prepare(costsOf(slopesBetweenWalls()), StopToken());
  std::size_t expanded = 0;
  SearchResult last = planner.search(near, StopToken());
  for (; last.answered_by == "a_star" && expanded < 10000000;
       last = planner.search(near, StopToken()))
    expanded += last.statistics.expanded;
  EXPECT_EQ(last.answered_by, "weighted_jump_point");
  EXPECT_GE(expanded, 3000000U);
  EXPECT_LE(expanded, 6000000U);
}

// The jumps take its place then.
TEST(FirstPlans, AStarGoesWhereMemoryHoldsOneOfBoth) {
  const auto map = costsOf(slopesBetweenWalls());
  AStar a_star;
  a_star.prepare(map, StopToken());
  const SearchResult least = a_star.search(kAcross, StopToken());
  WeightedJumpPoint planner;
  const std::size_t of_one = planner.bytesFor(map->geometry());
  planner.limitMemory(of_one);
  planner.prepare(map, StopToken());
  SearchResult last;
  for (int i = 0; i < 100 && last.answered_by != "weighted_jump_point"; ++i) {
    last = planner.search(kAcross, StopToken());
    ASSERT_EQ(last.cost, least.cost);
    EXPECT_LE(planner.bytesFor(map->geometry()), of_one);
  }
  EXPECT_EQ(last.answered_by, "weighted_jump_point");
}

TEST(FirstPlans, NoiseStaysWithAStar) {
  std::mt19937 random(3);
  Grid<CostGrid::Weight> weights(GridGeometry(640, 640, 1.0), 1);
  for (auto& weight : weights.values()) weight = static_cast<CostGrid::Weight>(1 + random() % 99);
  WeightedJumpPoint planner;
  planner.prepare(costsOf(weights), StopToken());
  EXPECT_TRUE(planner.backgroundWork().pending);
  planner.finishBackgroundWork(StopToken());
  EXPECT_FALSE(planner.backgroundWork().pending);
  EXPECT_EQ(planner.search(kAcross, StopToken()).answered_by, "a_star");
}

}  // namespace
}  // namespace grid_path_planner::planners
