// What every planner does with requests that it cannot answer: too little memory, wrong cells, no time left.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "planning/conformance.h"
#include "support/cost_maps.h"

namespace grid_path_planner::planning {

using base::Status;
using base::StopSource;
using base::StopToken;
using costmap::CostGrid;
using costmap::MotionModel;
using grid::Cell;
using grid::Grid;
using grid::GridGeometry;
using grid::Occupancy;
using planners::SearchRequest;
using planners::SearchResult;
using test::Conformance;
using test::sideFor;

namespace {

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
  EXPECT_NE(refused.message.find("600x600 cells, more than the "), std::string::npos)
      << refused.message;
  planner->prepare(small, StopToken());
  EXPECT_EQ(planner->search(request, StopToken()).status, Status::FOUND);
  planner->limitMemory(needed);
  planner->prepare(large, StopToken());
  EXPECT_EQ(planner->search(request, StopToken()).status, Status::FOUND);
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

}  // namespace
}  // namespace grid_path_planner::planning
