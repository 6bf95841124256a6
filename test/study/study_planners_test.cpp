#include "study/study_planners.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid_path_planner/planners/planner_factory.h"
#include "support/ascii_map.h"
#include "support/cost_maps.h"
#include "support/error_text.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::study {

using base::Status;
using base::StopToken;
using costmap::CostGrid;
using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;
using planners::Heuristic;
using planners::makePlanner;
using planners::Planner;
using planners::plannerNames;
using planners::PlannerTraits;
using planners::SearchOptions;
using planners::SearchResult;

namespace {

using test::costsOf;
using test::errorText;

SearchResult answerOf(std::unique_ptr<Planner> planner, const std::shared_ptr<const CostGrid>& map,
                      Cell start, Cell goal) {
  planner->prepare(map, StopToken());
  return planner->search({start, {goal}, false}, StopToken());
}

SearchResult eager(const std::shared_ptr<const CostGrid>& map, Cell start, Cell goal) {
  return answerOf(makeStudyPlanner("theta_star", {}, false), map, start, goal);
}

SearchResult eager(const test::AsciiMap& picture) {
  return eager(costsOf(picture.map), picture.start, picture.goal);
}

void expectTraitsOf(const std::string& name) {
  const PlannerTraits made = makeStudyPlanner(name, {}, false)->traits();
  EXPECT_EQ(made.name, name);
  EXPECT_EQ(guidedInStudies(name), made.heuristic) << name;
}

TEST(StudyPlanners, AreThePackagesAndTheirOwn) {
  for (const std::string& name : plannerNames()) {
    expectTraitsOf(name);
    EXPECT_FALSE(inStudiesOnly(name)) << name;
  }
  for (const char* name : {"theta_star", "a_star_published", "a_star_published_crossing",
                           "a_star_published_values", "dijkstra_published"}) {
    expectTraitsOf(name);
    EXPECT_TRUE(inStudiesOnly(name)) << name;
  }
  EXPECT_NE(errorText([] { makeStudyPlanner("a_starr", {}, false); }), "");
  EXPECT_NE(errorText([] { guidedInStudies("a_starr"); }), "");
  SearchOptions bad;
  bad.epsilon = 0.5;
  EXPECT_NE(errorText([&] { makeStudyPlanner("theta_star", bad, false); }), "");
}

TEST(StudyPlanners, RefuseAMapForWhichTheyHaveNoMemory) {
  const auto map = costsOf(OccupancyGrid(GridGeometry(400, 400, 1.0), 0));
  SearchOptions options;
  options.memory_limit = 1;
  for (const char* name : {"theta_star", "a_star_published", "dijkstra_published"})
    EXPECT_EQ(answerOf(makeStudyPlanner(name, options, false), map, {0, 0}, {1, 1}).status,
              Status::INVALID_REQUEST)
        << name;
}

// --- theta_star ----------------------------------------------------------------------------------

TEST(EagerThetaStar, CrossesOpenWaterInOneLine) {
  const SearchResult result = eager(test::AsciiMap({"S......",  //
                                                    ".......",  //
                                                    "......G"}));
  EXPECT_EQ(result.cells, (std::vector<Cell>{{0, 0}, {6, 2}}));
  EXPECT_NEAR(result.costValue(), std::hypot(6, 2), 1e-12);
}

TEST(EagerThetaStar, GoesAroundHighWeights) {
  const SearchResult result = eager(test::AsciiMap({"........",  //
                                                    "S.????.G",  //
                                                    "..????.."}));
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_LT(result.costValue(), 10.0) << "straight through unknown cells: 50 a cell";
}

// What is found on trust is no better than what was looked at, and hardly worse.
TEST(EagerThetaStarLaw, CostsAboutWhatLazyThetaStarCosts) {
  std::mt19937 random(2011);
  double found = 0.0, ratios = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto map = std::make_shared<const CostGrid>(test::randomCosts(random, 50, {}));
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    const SearchResult a = eager(map, start, goal);
    const SearchResult b = answerOf(makePlanner("lazy_theta_star"), map, start, goal);
    ASSERT_EQ(a.status, b.status);
    if (a.status != Status::FOUND || a.costValue() == 0.0) continue;
    EXPECT_LT(b.costValue(), 1.2 * a.costValue()) << "trial " << trial;
    found += 1.0;
    ratios += b.costValue() / a.costValue();
  }
  EXPECT_GT(found, 80.0);
  EXPECT_LT(ratios, 1.02 * found);
}

// Never below the straight line; together shorter than grid paths, which is what it is for.
TEST(EagerThetaStarLaw, LiesBetweenTheStraightLineAndTheGrid) {
  std::mt19937 random(2010);
  double any_angle = 0.0, grid = 0.0;
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto map = costsOf(test::randomOccupancy(random, 40, 0.1, 0.0));
    const Cell start = test::randomCell(random, map->geometry());
    const Cell goal = test::randomCell(random, map->geometry());
    const SearchResult result = eager(map, start, goal);
    const SearchResult steps = answerOf(makePlanner("a_star"), map, start, goal);
    ASSERT_EQ(result.status, steps.status);
    if (result.status != Status::FOUND) continue;
    ++found;
    const double line = std::hypot(start.column - goal.column, start.row - goal.row);
    EXPECT_GE(result.costValue(), line * (1.0 - 1e-12));
    EXPECT_LE(result.costValue(), steps.costValue() * (1.0 + 1e-12)) << "trial " << trial;
    any_angle += result.costValue();
    grid += steps.costValue();
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(any_angle, 0.98 * grid);
}

}  // namespace
}  // namespace grid_path_planner::study
