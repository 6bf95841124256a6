// One suite over every planner of the factory, with every heuristic and tie-break, on every
// motion model: what the Planner contract promises.
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/costmap/line_of_sight.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "planners/astar/heuristic.h"
#include "support/cost_maps.h"
#include "support/error_text.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planning {

using base::choiceFromName;
using base::choiceName;
using base::InputError;
using base::Status;
using base::StopSource;
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
using grid::GridGeometry;
using grid::Occupancy;
using planners::Heuristic;
using planners::makePlanner;
using planners::Planner;
using planners::plannerNames;
using planners::PlannerTraits;
using planners::prepared;
using planners::SearchOptions;
using planners::SearchRequest;
using planners::SearchResult;
using planners::TieBreak;

namespace {

struct Subject {
  std::string planner;
  SearchOptions options;
};

std::ostream& operator<<(std::ostream& out, const Subject& subject) {
  return out << subject.planner << ' ' << choiceName(subject.options.heuristic) << " scale "
             << subject.options.heuristic_scale << " epsilon " << subject.options.epsilon << ' '
             << choiceName(subject.options.tie_break);
}

// Larger ones would need tables for every pair of their cells.
int sideFor(const Subject& subject, int side) {
  return subject.options.heuristic == Heuristic::EXACT ? side / 4 : side;
}

std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (const std::string& planner : plannerNames()) {
    all.push_back({planner, {}});
    if (planner == "dijkstra") {
      SearchOptions ordered;
      ordered.tie_break = TieBreak::LARGER_G;
      all.push_back({planner, ordered});
    }
    if (planner != "a_star" && planner != "weighted_jump_point") continue;
    for (const auto& heuristic : choicesOf(Heuristic{}))
      for (const auto& tie_break : choicesOf(TieBreak{})) {
        SearchOptions options;
        if (prepared(heuristic.second) && tie_break.second != options.tie_break) continue;
        options.heuristic = heuristic.second;
        options.tie_break = tie_break.second;
        all.push_back({planner, options});
      }
    SearchOptions scaled;
    scaled.heuristic_scale = "1";
    all.push_back({planner, scaled});
    scaled.heuristic_scale = "30";
    all.push_back({planner, scaled});
    SearchOptions weighted;
    weighted.epsilon = 2.5;
    all.push_back({planner, weighted});
  }
  return all;
}

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

class Conformance : public ::testing::TestWithParam<Subject> {
 protected:
  std::unique_ptr<Planner> make() const {
    return makePlanner(GetParam().planner, GetParam().options);
  }
};

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
      const auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 24, motion));
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

TEST_P(Conformance, AMapThatNeedsMoreThanTheMemoryLimitIsRefusedBeforeMemoryIsTaken) {
  const auto uniform = [](int side) {
    return test::costsOf(test::Weights(GridGeometry(side, side, 1.0), 1));
  };
  const auto small = uniform(20), large = uniform(600);
  const auto planner = make();
  const std::size_t needed = planner->bytesFor(large->geometry());
  ASSERT_GT(needed, 0U);
  planner->limitMemory(needed - 1);
  planner->prepare(large, StopToken());
  const SearchRequest request{{1, 2}, {{15, 17}}, false};
  const SearchResult refused = planner->search(request, StopToken());
  EXPECT_EQ(refused.status, Status::INVALID_REQUEST);
  EXPECT_NE(refused.message.find("600x600 cells, more than its memory_limit of"), std::string::npos)
      << refused.message;
  planner->prepare(small, StopToken());
  EXPECT_EQ(planner->search(request, StopToken()).status, Status::FOUND);
  planner->limitMemory(needed);
  planner->prepare(large, StopToken());
  EXPECT_EQ(planner->search(request, StopToken()).status, Status::FOUND);
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
    CostGrid before = test::randomCosts(random, 30, {});
    Grid<CostGrid::Weight> weights = before.weights();
    const Cell low = test::randomCell(random, before.geometry());
    const CellRect changed =
        CellRect{low.column, low.row, 5, 4}.intersection(before.geometry().rect());
    for (int row = changed.row; row < changed.row + changed.height; ++row)
      for (int column = changed.column; column < changed.column + changed.width; ++column)
        weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 3);
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

TEST_P(Conformance, NamesWhatIsWrongWithARequest) {
  const auto planner = make();
  EXPECT_EQ(planner->search({{0, 0}, {{0, 0}}, false}, StopToken()).status, Status::NO_MAP);
  Grid<CostGrid::Weight> weights(GridGeometry(3, 2, 1.0), 1);
  weights[Cell{2, 1}] = CostGrid::kBlocked;
  const Grid<Occupancy> classes(weights.geometry(), Occupancy::FREE);
  planner->prepare(std::make_shared<const CostGrid>(weights, classes, MotionModel()), StopToken());
  const auto statusOf = [&planner](Cell start, std::vector<Cell> goals) {
    return planner->search({start, std::move(goals), false}, StopToken()).status;
  };
  EXPECT_EQ(statusOf({0, 0}, {}), Status::INVALID_REQUEST);
  EXPECT_EQ(statusOf({-1, 0}, {{1, 1}}), Status::START_OUTSIDE_MAP);
  EXPECT_EQ(statusOf({0, 0}, {{3, 0}}), Status::GOAL_OUTSIDE_MAP);
  EXPECT_EQ(statusOf({0, 0}, {{0, -7}}), Status::GOAL_OUTSIDE_MAP);
  EXPECT_EQ(statusOf({2, 1}, {{0, 0}}), Status::START_OCCUPIED);
  EXPECT_EQ(statusOf({0, 0}, {{2, 1}}), Status::GOAL_OCCUPIED);
  EXPECT_EQ(statusOf({0, 0}, {{0, 0}}), Status::FOUND);
  const bool several = planner->traits().several_goals;
  EXPECT_EQ(statusOf({0, 0}, {{2, 0}, {1, 0}}), several ? Status::FOUND : Status::INVALID_REQUEST);
}

TEST_P(Conformance, StopsWhenAsked) {
  const int side = sideFor(GetParam(), 200);
  const SearchRequest request{{0, 0}, {{side - 1, side * 3 / 4}}, false};
  const Grid<CostGrid::Weight> weights(GridGeometry(side, side, 1.0), 1);
  const Grid<Occupancy> classes(weights.geometry(), Occupancy::FREE);
  const auto planner = make();
  planner->prepare(std::make_shared<const CostGrid>(weights, classes, MotionModel()), StopToken());
  StopSource source;
  const StopToken expired = source.token(std::chrono::duration<double>(0.0));
  EXPECT_EQ(planner->search(request, expired).status, Status::TIMEOUT);
  source.cancel();
  const SearchResult cancelled = planner->search(request, source.token());
  EXPECT_EQ(cancelled.status, Status::CANCELLED);
  EXPECT_TRUE(cancelled.cells.empty());
  EXPECT_FALSE(cancelled.message.empty());
  EXPECT_EQ(planner->search(request, StopToken()).status, Status::FOUND);
}

// A stopped search returns its statistics so far.
TEST_P(Conformance, StoppedSearchesKeepTheirStatistics) {
  const int side = sideFor(GetParam(), 160);
  const int middle = side / 2;
  const Grid<CostGrid::Weight> weights(GridGeometry(side, side, 1.0), 1);
  const Grid<Occupancy> classes(weights.geometry(), Occupancy::FREE);
  auto walled = weights;  // the goal is walled in: every cell is expanded before it is given up
  for (const Cell step : {Cell{1, 0}, Cell{0, 1}, Cell{1, 1}, Cell{-1, 0}, Cell{0, -1},
                          Cell{-1, -1}, Cell{1, -1}, Cell{-1, 1}})
    walled[Cell{middle + step.column, middle + step.row}] = CostGrid::kBlocked;
  const auto planner = make();
  planner->prepare(std::make_shared<const CostGrid>(walled, classes, MotionModel()), StopToken());
  const SearchRequest request{{0, 0}, {{middle, middle}}, false};
  const SearchResult whole = planner->search(request, StopToken());
  ASSERT_EQ(whole.status, Status::UNREACHABLE);
  // On a busy machine the time may be over before the search began: ask more than once.
  int silent = 0;
  for (int i = 1; i <= 10; ++i) {
    const StopSource source;
    const SearchResult part = planner->search(
        request, source.token(std::chrono::duration<double>(whole.statistics.time_s * i / 11)));
    ASSERT_TRUE(part.status == Status::TIMEOUT || part.status == Status::UNREACHABLE);
    if (part.status == Status::UNREACHABLE) continue;
    EXPECT_LE(part.statistics.expanded, whole.statistics.expanded);
    if (part.statistics.expanded == 0 || part.statistics.search_bytes == 0) ++silent;
  }
  EXPECT_LT(silent, 10);
}

INSTANTIATE_TEST_SUITE_P(PlannerFactory, Conformance, ::testing::ValuesIn(subjects()));

TEST(Dijkstra, AnswersTheNearestOfSeveralGoals) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 24, {}));
    const Cell start = test::randomCell(random, map->geometry());
    if (!map->passable(start)) continue;
    std::vector<Cell> goals;
    for (int i = 0; i < 5; ++i) goals.push_back(test::randomCell(random, map->geometry()));
    const auto planner = makePlanner("dijkstra");
    planner->prepare(map, StopToken());
    const SearchResult result = planner->search({start, goals, false}, StopToken());
    std::optional<ExactCost> least;
    const auto costs = test::referenceCosts(*map, start);
    for (const Cell goal : goals) {
      const auto cost = costs[map->geometry().index(goal).value()];
      if (cost && (!least || *cost < *least)) least = cost;
    }
    ASSERT_EQ(result.status == Status::FOUND, least.has_value()) << result.message;
    if (least) {
      EXPECT_EQ(result.cost, *least);
    }
  }
}

// A study compared A* in strict order with Dijkstra on buckets, and found Dijkstra the faster.
TEST(Dijkstra, KeepsAStrictOrderWhereATieBreakAsksAStarForOne) {
  std::mt19937 random(17);
  SearchOptions options;
  options.tie_break = TieBreak::LARGER_G;
  for (int trial = 0; trial < 60; ++trial) {
    const auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 30, {}));
    const SearchRequest request{test::randomCell(random, map->geometry()),
                                {test::randomCell(random, map->geometry())},
                                true};
    const auto planner = makePlanner("dijkstra", options);
    planner->prepare(map, StopToken());
    const SearchResult result = planner->search(request, StopToken());
    EXPECT_EQ(result.statistics.reopened, 0U);
    const auto costs = test::referenceCosts(*map, request.start);
    for (std::size_t i = 1; i < result.expanded.size(); ++i)
      ASSERT_FALSE(*costs[result.expanded[i].value()] < *costs[result.expanded[i - 1].value()]);
  }
}

TEST(PlannerFactory, RefusesUnknownNamesAndOptions) {
  EXPECT_THROW(makePlanner("a_starr"), InputError);
  SearchOptions options;
  options.heuristic_scale = "cheap";
  EXPECT_THROW(makePlanner("a_star", options), InputError);
  options.heuristic_scale = "-1";
  EXPECT_THROW(makePlanner("a_star", options), InputError);
  options.heuristic_scale = "cheapest";
  options.epsilon = 0.5;
  EXPECT_THROW(makePlanner("a_star", options), InputError);
}

TEST(PlannerFactory, SaysWhatToTakeInsteadOfARetiredPlanner) {
  EXPECT_EQ(test::errorText([] { makePlanner("coarse_to_fine"); }),
            "planner 'coarse_to_fine' is retired: take a_star or weighted_jump_point");
  EXPECT_EQ(test::errorText([] { makePlanner("theta_star"); }),
            "planner 'theta_star' is in `grid_path study` only: take lazy_theta_star");
  EXPECT_EQ(test::errorText([] { makePlanner("a_star_published"); }),
            "planner 'a_star_published' is in `grid_path study` only: take a_star");
  EXPECT_EQ(
      test::errorText([] { choiceFromName<TieBreak>("tie_break", "cross_product_published"); }),
      "tie_break 'cross_product_published' is in `grid_path study` only: take cross_product");
}

}  // namespace
}  // namespace grid_path_planner::planning
