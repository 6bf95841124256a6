// What every planner answers, on every motion model: legal paths, of the least cost where that is claimed, the
// same path again, and the same path after an update.
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "planners/astar/heuristic.h"
#include "planning/conformance.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopToken;
using costmap::Connectivity;
using costmap::CostGrid;
using costmap::costOfSteps;
using costmap::DiagonalCost;
using costmap::ExactCost;
using costmap::lineCost;
using costmap::lineOfSight;
using costmap::MotionModel;
using costmap::SegmentPoint;
using costmap::stepAllowed;
using costmap::waypointOf;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using planners::Heuristic;
using planners::PlannerTraits;
using planners::prepared;
using planners::SearchOptions;
using planners::SearchRequest;
using planners::SearchResult;
using test::Conformance;
using test::Subject;
using test::subjects;

namespace {

std::vector<MotionModel> motionModels() {
  std::vector<MotionModel> models;
  for (const auto& connectivity : choicesOf(Connectivity{}))
    for (const auto& diagonal : choicesOf(DiagonalCost{}))
      for (const bool cut : {false, true})
        models.push_back({connectivity.second, diagonal.second, cut});
  return models;
}

// Tables that were repaired bound other cells than new ones: of paths of equal cost another may be
// found. Rectangles that were repaired are others.
bool mayDifferAfterUpdates(const Subject& subject) {
  return prepared(subject.options.heuristic) || subject.planner == "rectangle_map";
}

bool neighbours(Cell a, Cell b) {
  return a != b && std::abs(a.column - b.column) <= 1 && std::abs(a.row - b.row) <= 1;
}

// Whether the planner says that it cannot search the map.
bool refuses(const PlannerTraits& traits, const CostGrid& map) {
  const MotionModel& motion = map.motion();
  return (motion.connectivity == Connectivity::FOUR && !traits.four_connected) ||
         (motion.diagonal_cost == DiagonalCost::UNIT && !traits.unit_diagonals) ||
         (motion.cut_corners && !traits.cut_corners) || (!map.uniform() && !traits.weights);
}

// Whether the point lies in the cell or on its edge.
bool touches(Cell cell, SegmentPoint point) {
  const SegmentPoint centre = SegmentPoint::centreOf(cell);
  return 2 * std::max(std::abs(point.x - centre.x), std::abs(point.y - centre.y)) <=
         SegmentPoint::kUnitsPerCell;
}

void expectLegalSegments(const CostGrid& map, const SearchResult& result) {
  ASSERT_EQ(result.points.size(), result.cells.size());
  EXPECT_EQ(result.points.front(), waypointOf(map, result.cells.front()));
  EXPECT_EQ(result.points.back(), waypointOf(map, result.cells.back()));
  double cost = 0.0;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    ASSERT_TRUE(map.passable(result.cells[i]));
    ASSERT_TRUE(touches(result.cells[i], result.points[i]));
    if (i == 0) continue;
    ASSERT_NE(result.points[i - 1], result.points[i]);
    ASSERT_TRUE(lineOfSight(map, result.points[i - 1], result.points[i]));
    cost += lineCost(map, result.points[i - 1], result.points[i]);
  }
  EXPECT_EQ(result.cost, ExactCost());
  EXPECT_NEAR(result.segment_cost, cost, 1e-9 * cost);
}

void expectLegalSteps(const CostGrid& map, const SearchResult& result) {
  EXPECT_EQ(result.segment_cost, 0.0);
  EXPECT_TRUE(result.points.empty());
  for (std::size_t i = 1; i < result.cells.size(); ++i) {
    EXPECT_TRUE(neighbours(result.cells[i - 1], result.cells[i]));
    ASSERT_TRUE(stepAllowed(map, result.cells[i - 1], result.cells[i]));
  }
  EXPECT_EQ(result.cost, costOfSteps(map, result.cells));
}

TEST_P(Conformance, AnswersAreLegalAndTheLeastCostWhereOptimalityIsClaimed) {
  for (const MotionModel& motion : motionModels()) {
    std::mt19937 random(20261121);
    for (int trial = 0; trial < 25; ++trial) {
      CostGrid costs = test::randomCosts(random, 24, motion);
      if (trial % 3 == 0) costs.setKeptDistances({0.5, -1.0, 0.0});
      const auto map = std::make_shared<const CostGrid>(std::move(costs));
      const SearchRequest request{test::randomCell(random, map->geometry()),
                                  {test::randomCell(random, map->geometry())},
                                  false};
      const auto planner = make();
      planner->prepare(map, StopToken());
      if (trial % 2 == 0) planner->finishBackgroundWork(StopToken());
      const SearchResult result = planner->search(request, StopToken());
      SCOPED_TRACE("trial " + std::to_string(trial) + ", " + result.message);
      if (refuses(planner->traits(), *map)) {
        EXPECT_EQ(result.status, Status::INVALID_REQUEST);
        continue;
      }
      if (!map->passable(request.start)) {
        EXPECT_EQ(result.status, Status::START_OCCUPIED);
        continue;
      }
      if (!map->passable(request.goals.front())) {
        EXPECT_EQ(result.status, Status::GOAL_OCCUPIED);
        continue;
      }
      const auto least = test::referenceCosts(
          *map, request.start)[map->geometry().index(request.goals.front()).value()];
      ASSERT_EQ(result.status, least ? Status::FOUND : Status::UNREACHABLE);
      if (!least) continue;
      ASSERT_FALSE(result.cells.empty());
      EXPECT_EQ(result.cells.front(), request.start);
      EXPECT_EQ(result.cells.back(), request.goals.front());
      if (planner->traits().any_angle) {
        expectLegalSegments(*map, result);
        continue;
      }
      expectLegalSteps(*map, result);
      EXPECT_FALSE(result.cost < *least);
      if (planner->optimalFor(*map)) {
        EXPECT_EQ(result.cost, *least);
      }
    }
  }
}

TEST_P(Conformance, EpsilonBoundsTheCost) {
  const SearchOptions& options = GetParam().options;
  if (GetParam().planner != "a_star" && GetParam().planner != "weighted_jump_point") return;
  std::mt19937 random(7);
  for (int trial = 0; trial < 40; ++trial) {
    const auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 24, {}));
    if (options.heuristic_scale != "cheapest" || !map->minWeight()) continue;
    if (options.heuristic == Heuristic::MANHATTAN) continue;
    const SearchRequest request{test::randomCell(random, map->geometry()),
                                {test::randomCell(random, map->geometry())},
                                false};
    const auto planner = make();
    planner->prepare(map, StopToken());
    const SearchResult result = planner->search(request, StopToken());
    if (result.status != Status::FOUND) continue;
    const auto least = test::referenceCosts(
        *map, request.start)[map->geometry().index(request.goals.front()).value()];
    EXPECT_LE(result.cost.toDouble(), options.epsilon * least->toDouble() * (1.0 + 1e-12));
  }
}

// Plateaus, on which jumps pay.
std::shared_ptr<const CostGrid> plateaus(int side, std::uint64_t revision) {
  grid::Grid<CostGrid::Weight> weights(grid::GridGeometry(side, side, 1.0));
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      weights[Cell{column, row}] =
          static_cast<CostGrid::Weight>(1 + 3 * ((column / 16 + row / 16) % 2));
  return test::costsOf(weights, {}, revision);
}

// A map that grew beyond memory_limit while the node was idle: the default planner then went on with
// what it had prepared of the smaller one, outside of its memory.
TEST_P(Conformance, DoesNothingInIdleTimeForAMapThatItRefuses) {
  const auto small = plateaus(64, 1), large = plateaus(300, 2);
  const auto planner = make();
  planner->prepare(small, StopToken());
  planner->limitMemory(planner->bytesFor(small->geometry()));
  planner->update(large, {{0, 0, 300, 300}}, StopToken());
  const SearchRequest request{{1, 1}, {{60, 50}}, false};
  ASSERT_EQ(planner->search(request, StopToken()).status, Status::INVALID_REQUEST);
  EXPECT_FALSE(planner->backgroundWork().pending);
  planner->finishBackgroundWork(StopToken());
  planner->update(small, {{0, 0, 64, 64}}, StopToken());
  planner->finishBackgroundWork(StopToken());
  const bool refuses_weights = !planner->traits().weights;
  EXPECT_EQ(planner->search(request, StopToken()).status,
            refuses_weights ? Status::INVALID_REQUEST : Status::FOUND);
}

TEST_P(Conformance, SameQuestionSameAnswer) {
  std::mt19937 random(3);
  const auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 60, {}));
  const auto planner = make();
  planner->prepare(map, StopToken());
  planner->finishBackgroundWork(StopToken());
  for (int trial = 0; trial < 20; ++trial) {
    const SearchRequest request{test::randomCell(random, map->geometry()),
                                {test::randomCell(random, map->geometry())},
                                true};
    const SearchResult first = planner->search(request, StopToken());
    const SearchResult second = planner->search(request, StopToken());
    const auto fresh = make();
    fresh->prepare(map, StopToken());
    fresh->finishBackgroundWork(StopToken());
    const SearchResult third = fresh->search(request, StopToken());
    EXPECT_EQ(first.statistics.expanded, first.expanded.size());
    EXPECT_EQ(first.cost, second.cost);
    EXPECT_EQ(first.cells, second.cells);
    EXPECT_EQ(first.cost, third.cost);
    if (planner->traits().incremental) continue;
    EXPECT_EQ(first.cells, third.cells);
    EXPECT_EQ(first.expanded, third.expanded);
    EXPECT_EQ(first.statistics.expanded, third.statistics.expanded);
  }
}

TEST_P(Conformance, AnUpdatedMapIsPlannedLikeAFreshOne) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 20; ++trial) {
    CostGrid before =
        test::randomCosts(random, trial % 4 == 3 ? test::sideFor(GetParam(), 90) : 30, {});
    Grid<CostGrid::Weight> weights = before.weights();
    const std::vector<CellRect> changed = test::randomRects(random, before.geometry(), 5);
    for (const CellRect& each : changed) {
      const CellRect rect = each.intersection(before.geometry().rect());
      for (int row = rect.row; row < rect.row + rect.height; ++row)
        for (int column = rect.column; column < rect.column + rect.width; ++column)
          weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 3);
    }
    auto after = std::make_shared<CostGrid>(weights, before.classes(), before.motion());
    after->setRevision(before.revision() + 1);

    const auto updated = make();
    updated->prepare(std::make_shared<const CostGrid>(before), StopToken());
    updated->update(after, changed, StopToken());
    const auto fresh = make();
    fresh->prepare(after, StopToken());
    for (int query = 0; query < 10; ++query) {
      const SearchRequest request{test::randomCell(random, after->geometry()),
                                  {test::randomCell(random, after->geometry())},
                                  false};
      const SearchResult a = updated->search(request, StopToken());
      const SearchResult b = fresh->search(request, StopToken());
      EXPECT_EQ(a.status, b.status);
      if (mayDifferAfterUpdates(GetParam()))
        EXPECT_TRUE(a.cost == b.cost || !updated->optimalFor(*after));
      else
        EXPECT_EQ(a.cells, b.cells);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PlannerFactory, Conformance, ::testing::ValuesIn(subjects()));

}  // namespace
}  // namespace grid_path_planner::planning
