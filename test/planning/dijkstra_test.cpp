#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "grid_path_planner/planners/planner_factory.h"
#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopToken;
using costmap::CostGrid;
using costmap::ExactCost;
using grid::Cell;
using planners::makePlanner;
using planners::SearchOptions;
using planners::SearchRequest;
using planners::SearchResult;
using planners::TieBreak;

namespace {

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

}  // namespace
}  // namespace grid_path_planner::planning
