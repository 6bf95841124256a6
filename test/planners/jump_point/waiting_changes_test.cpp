// Changes that the jumps have not followed while the tree of a goal answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "planners/astar/a_star.h"
#include "planners/jump_point/walls.h"
#include "planners/jump_point/weighted_jump_point.h"
#include "support/cost_maps.h"
#include "support/random_map.h"

namespace grid_path_planner::planners {

using base::StopSource, base::StopToken;
using costmap::CostGrid;
using grid::Cell, grid::CellRect, grid::Grid;

namespace {

const SearchRequest kBetweenWalls{{5, 5}, {{630, 630}}, false};

// A planner whose jumps are prepared and whose tree answers, and its map.
struct AskedVehicle {
  AskedVehicle() {
    planner.prepare(test::costsOf(weights), StopToken());
    for (int column = 20; column < 320; column += 100) {
      change({column, column, 1, 1}, 9);
      ask(kBetweenWalls);
      planner.finishBackgroundWork(StopToken());
    }
  }
  void change(const CellRect& rect, CostGrid::Weight weight) {
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      std::fill_n(weights.row(row) + rect.column, rect.width, weight);
    planner.update(map(), {rect}, StopToken());
  }
  std::shared_ptr<const CostGrid> map() { return test::costsOf(weights, {}, ++revision); }
  // Without a pause.
  void changeMuch(std::mt19937& random, int times) {
    for (int i = 0; i < times; ++i) {
      const int column = 30 + int(random() % 560), row = 30 + int(random() % 560);
      change({column, row, 1 + int(random() % 9), 1 + int(random() % 9)}, int(random() % 40));
    }
  }
  void idleUntil(const StopToken& stop) {
    try {
      planner.finishBackgroundWork(stop);
    } catch (const base::Stopped&) {
    }
  }
  SearchResult ask(const SearchRequest& request) { return planner.search(request, StopToken()); }

  Grid<CostGrid::Weight> weights = test::slopesBetweenWalls();
  std::uint64_t revision = 1;
  WeightedJumpPoint planner;
};

TEST(WeightedJumpPoint, ItsTreeAnswersWhileChangesWaitForTheJumps) {
  AskedVehicle vehicle;
  vehicle.change({600, 20, 2, 2}, 60);
  EXPECT_TRUE(vehicle.planner.backgroundWork().pending);
  EXPECT_EQ(vehicle.ask(kBetweenWalls).answered_by, "incremental_a_star");
  vehicle.planner.finishBackgroundWork(StopToken());
  EXPECT_FALSE(vehicle.planner.backgroundWork().pending);
}

// The tiles that the stopped one had given up were not made any more, and A* was prepared for the whole map instead.
TEST(WeightedJumpPoint, JumpsAnswerAfterFollowingAChangeWasStopped) {
  AskedVehicle vehicle;
  vehicle.change({70, 330, 50, 50}, 30);
  StopSource cancelled;
  cancelled.cancel();
  EXPECT_THROW(vehicle.planner.finishBackgroundWork(cancelled.token()), base::Stopped);
  EXPECT_TRUE(vehicle.planner.backgroundWork().pending);
  EXPECT_EQ(vehicle.ask({{75, 325}, {{620, 350}}, false}).answered_by, "weighted_jump_point");
}

// Asked for other goals after as many changes as may wait, after more, and after an idle time that ended
// while they were followed.
TEST(WeightedJumpPointLaw, JumpsFollowAllChangesThatWaited) {
  std::mt19937 random(31);
  StopSource cancelled;
  cancelled.cancel();
  AskedVehicle vehicle;
  int by_jumps = 0;
  for (int times = 1; times <= 40; ++times) {
    SCOPED_TRACE(std::to_string(times % 21) + " changes");
    vehicle.changeMuch(random, times % 21);
    AStar a_star;
    a_star.prepare(test::costsOf(vehicle.weights), StopToken());
    if (times % 2 == 0) vehicle.idleUntil(cancelled.token());
    for (int i = 0; i < 4; ++i) {
      const Cell start = test::randomCell(random, vehicle.weights.geometry());
      const Cell goal = test::randomCell(random, vehicle.weights.geometry());
      const SearchRequest request{start, {goal}, false};
      const SearchResult result = vehicle.ask(request),
                         expected = a_star.search(request, StopToken());
      ASSERT_EQ(result.status, expected.status);
      ASSERT_EQ(result.cost, expected.cost);
      by_jumps += result.answered_by == "weighted_jump_point" ? 1 : 0;
    }
    ASSERT_EQ(vehicle.ask(kBetweenWalls).cost, a_star.search(kBetweenWalls, StopToken()).cost);
    vehicle.planner.finishBackgroundWork(StopToken());
  }
  EXPECT_GT(by_jumps, 40);
}

}  // namespace
}  // namespace grid_path_planner::planners
