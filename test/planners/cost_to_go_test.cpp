#include "planners/tables/cost_to_go.h"

#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "grid_path_planner/base/errors.h"
#include "support/cost_maps.h"
#include "support/error_text.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planners {

using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::DiagonalCost;
using costmap::ExactCost;
using costmap::MotionModel;
using costmap::stepAllowed;
using costmap::stepCost;
using grid::Cell;
using grid::CellIndex;
using grid::Grid;
using grid::GridGeometry;
using grid::Occupancy;
using test::cellsOf;
using test::costsOf;

namespace {

Cell passableCell(std::mt19937& random, const CostGrid& map) {
  for (;;) {
    const Cell cell = test::randomCell(random, map.geometry());
    if (map.passable(cell)) return cell;
  }
}

void expectLeastCosts(const CostToGo& field, const std::vector<Cell>& goals) {
  const CostGrid& map = field.map();
  std::vector<std::vector<std::optional<ExactCost>>> references;
  for (const Cell goal : goals)
    if (map.passable(goal)) references.push_back(test::referenceCosts(map, goal));
  for (const Cell cell : cellsOf(map)) {
    std::optional<ExactCost> least;
    for (const auto& reference : references) {
      const auto& cost = reference[map.geometry().index(cell).value()];
      if (cost && (!least || *cost < *least)) least = cost;
    }
    if (!map.passable(cell)) least.reset();
    ASSERT_EQ(field.reached(cell), least.has_value()) << cell;
    if (least) {
      ASSERT_EQ(field.cost(cell), *least) << cell;
    }
  }
}

void expectLeastPath(const CostToGo& field, Cell cell, const std::vector<Cell>& goals) {
  const std::vector<Cell> path = field.pathFrom(cell);
  ASSERT_EQ(path.front(), cell);
  ASSERT_NE(std::find(goals.begin(), goals.end(), path.back()), goals.end());
  ExactCost cost;
  for (std::size_t i = 1; i < path.size(); ++i) {
    ASSERT_TRUE(stepAllowed(field.map(), path[i - 1], path[i]));
    cost += stepCost(field.map(), path[i - 1], path[i]);
  }
  EXPECT_EQ(cost, field.cost(cell));
}

// Sides beyond a tile's, so that paths leave a tile and enter it again; every motion model.
TEST(CostToGoLaw, LabelsEveryCellWithItsLeastCost) {
  std::mt19937 random(128);
  int trial = 0;
  for (const Connectivity connectivity : {Connectivity::EIGHT, Connectivity::FOUR})
    for (const DiagonalCost diagonal : {DiagonalCost::SQRT2, DiagonalCost::UNIT})
      for (const bool cut : {false, true})
        for (int i = 0; i < 3; ++i) {
          SCOPED_TRACE(++trial);
          const auto map = std::make_shared<const CostGrid>(
              test::randomCosts(random, 300, {connectivity, diagonal, cut}));
          std::vector<Cell> goals;
          for (int goal = 0; goal <= i; ++goal)
            goals.push_back(test::randomCell(random, map->geometry()));
          const CostToGo field(map, goals, 1 + trial % 3, StopToken());
          expectLeastCosts(field, goals);
        }
}

// Each half of a tile has one weight, and here and there a cell is blocked: tiles that are swept
// over beside tiles that are searched, at the map's border too.
TEST(CostToGoLaw, OpenTilesBesideOthers) {
  std::mt19937 random(5);
  int trial = 0;
  for (const Connectivity connectivity : {Connectivity::EIGHT, Connectivity::FOUR})
    for (const DiagonalCost diagonal : {DiagonalCost::SQRT2, DiagonalCost::UNIT})
      for (const bool cut : {false, true})
        for (const int kinds : {1, 2}) {
          SCOPED_TRACE(++trial);
          const GridGeometry geometry(300 + static_cast<int>(random() % 130), 290, 1.0);
          Grid<CostGrid::Weight> areas(GridGeometry(16, 16, 1.0)), weights(geometry);
          for (auto& weight : areas.values()) weight = random() % kinds * 6 + 1;
          for (int row = 0; row < geometry.height(); ++row)
            for (int column = 0; column < geometry.width(); ++column)
              weights[Cell{column, row}] = areas[Cell{column / 128, row / 64}];
          for (int i = 0; i < 3; ++i) {
            const Cell corner = test::randomCell(random, geometry);
            for (int length = 0; length < 40 && corner.column + length < 300; ++length)
              weights[Cell{corner.column + length, corner.row}] = 0;
          }
          const auto map = costsOf(std::move(weights), {connectivity, diagonal, cut});
          const std::vector<Cell> goals = {passableCell(random, *map), passableCell(random, *map)};
          const CostToGo field(map, goals, 1 + trial % 2, StopToken());
          expectLeastCosts(field, goals);
          expectLeastPath(field, passableCell(random, *map), goals);
        }
}

TEST(CostToGoLaw, PathsAreOfLeastCost) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 20; ++trial) {
    const auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 200, {}));
    const Cell goal = passableCell(random, *map);
    const CostToGo field(map, {goal}, 2, StopToken());
    for (int i = 0; i < 20; ++i) {
      const Cell cell = passableCell(random, *map);
      if (field.reached(cell)) expectLeastPath(field, cell, {goal});
    }
  }
}

// Labels are those of one thread for any number of them, byte for byte.
TEST(CostToGo, HasTheSameLabelsForAnyNumberOfThreads) {
  std::mt19937 random(2);
  Grid<CostGrid::Weight> weights(GridGeometry(700, 500, 1.0));
  for (auto& weight : weights.values())
    weight = static_cast<CostGrid::Weight>(random() % 5 == 0 ? 0 : 1 + random() % 3);
  const auto map = costsOf(std::move(weights));
  const Cell goal = passableCell(random, *map);
  const CostToGo one(map, {goal}, 1, StopToken());
  for (const int threads : {2, 3, 7}) {
    const CostToGo several(map, {goal}, threads, StopToken());
    for (const Cell cell : cellsOf(*map)) ASSERT_EQ(several.key(cell), one.key(cell));
  }
}

// 47,321 cells x weight are the most that narrow labels can hold.
TEST(CostToGo, LabelsGrowWideWhereCostsAreLarge) {
  Grid<CostGrid::Weight> weights(GridGeometry(200, 1, 1.0), 200);
  const CostToGo narrow(costsOf(weights), {{0, 0}}, 1, StopToken());
  EXPECT_EQ(narrow.bytes(), 2u * 128 * 128 * 4);
  EXPECT_EQ(narrow.cost({199, 0}), (ExactCost{199 * 200, 0}));
  const CostToGo alike(costsOf(Grid<CostGrid::Weight>(weights.geometry(), 65535)), {{0, 0}}, 1,
                       StopToken());
  EXPECT_EQ(alike.bytes(), narrow.bytes()) << "costs over the one weight";
  EXPECT_EQ(alike.cost({199, 0}), (ExactCost{199 * 65535, 0}));
  for (auto& weight : weights.values()) weight = 65535;
  weights[Cell{1, 0}] = 65534;
  const CostToGo wide(costsOf(weights), {{0, 0}}, 1, StopToken());
  EXPECT_EQ(wide.bytes(), 2u * 128 * 128 * 8);
  EXPECT_EQ(wide.cost({199, 0}), (ExactCost{199 * 65535, 0}));
  EXPECT_EQ(wide.keyIn(kPackedScale, {1, 0}), 65535 * kPackedScale.straight);
}

// A map whose sampled weights are small and whose costs are large: the search is repeated.
TEST(CostToGo, RepeatsWithWideLabelsWhereNarrowOnesOverflow) {
  Grid<CostGrid::Weight> weights(GridGeometry(183, 61, 1.0), 1);
  for (int row = 0; row < 61; ++row) weights[Cell{91, row}] = 65535;
  const auto map = costsOf(std::move(weights));
  const CostToGo field(map, {{0, 30}}, 2, StopToken());
  EXPECT_EQ(field.scale().straight, kStraightKey);
  expectLeastCosts(field, {{0, 30}});
}

// In the open as among obstacles, of one weight or several: no cost is left out without a word.
TEST(CostToGo, RefusesWhatCostsTooMuchInTheOpen) {
  Grid<CostGrid::Weight> weights(GridGeometry(60000, 1, 1.0), 65535);
  EXPECT_THROW(CostToGo(costsOf(weights), {{0, 0}}, 1, StopToken()), TooExpensive);
  weights[Cell{59999, 0}] = 1;
  EXPECT_THROW(CostToGo(costsOf(std::move(weights)), {{0, 0}}, 1, StopToken()), TooExpensive);
}

TEST(CostToGo, CountsTheKernel) {
  const GridGeometry geometry(5, 4, 3.0), original(15, 12, 1.0);
  const Grid<CostGrid::Weight> weights(geometry, 2);
  const Grid<Occupancy> classes(geometry, Occupancy::FREE);
  const auto map = std::make_shared<const CostGrid>(weights, classes, MotionModel(), 3, original);
  const CostToGo field(map, {{0, 0}}, 1, StopToken());
  EXPECT_EQ(field.cost({4, 1}), (ExactCost{3 * 3 * 2, 3 * 2}));
}

TEST(CostToGo, SaysWhatIsWrongWithItsArguments) {
  const auto map = costsOf(Grid<CostGrid::Weight>(GridGeometry(4, 3, 1.0), 1));
  const auto errorOf = [&map](const std::vector<Cell>& goals, int threads) {
    return test::errorText([&] { CostToGo(map, goals, threads, StopToken()); });
  };
  EXPECT_EQ(errorOf({}, 1), "a cost-to-go needs a goal, got none");
  EXPECT_EQ(errorOf({{0, 0}, {4, 0}}, 1), "goal (4, 0) lies outside the map of 4x3 cells");
  EXPECT_EQ(errorOf({{0, 0}}, 0), "threads must be at least 1, got 0");
}

TEST(CostToGo, IsReachedFromNowhereWhereTheGoalIsBlocked) {
  Grid<CostGrid::Weight> weights(GridGeometry(4, 3, 1.0), 1);
  weights[Cell{1, 1}] = CostGrid::kBlocked;
  const CostToGo field(costsOf(std::move(weights)), {{1, 1}}, 2, StopToken());
  for (const Cell cell : cellsOf(field.map())) EXPECT_FALSE(field.reached(cell));
}

TEST(CostToGo, StopsWhenAsked) {
  const auto map = costsOf(Grid<CostGrid::Weight>(GridGeometry(600, 600, 1.0), 1));
  StopSource source;
  source.cancel();
  for (const int threads : {1, 2})
    EXPECT_THROW(CostToGo(map, {{0, 0}}, threads, source.token()), Stopped);
}

}  // namespace
}  // namespace grid_path_planner::planners
