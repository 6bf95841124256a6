#include "grid_path_planner/search/coarse_to_fine.h"

#include <gtest/gtest.h>

#include <random>

#include "support/random_map.h"
#include "support/reference_search.h"

namespace grid_path_planner {
namespace {

PlanResult planOn(const CostGrid& map, const PlanRequest& request, double accuracy = 1.05) {
  SearchOptions options;
  options.accuracy = accuracy;
  CoarseToFine planner(options);
  planner.prepare(std::make_shared<const CostGrid>(map), StopToken());
  return planner.plan(request, StopToken());
}

CostGrid openMap(int width, int height) {
  const GridGeometry geometry(width, height, 1.0);
  return CostGrid(Grid<CostGrid::Weight>(geometry, 1), Grid<Occupancy>(geometry, Occupancy::FREE),
                  {});
}

// A wall one cell thick through the middle of sectors, with a door of one cell far away: blocks
// would let the way through the wall or close the door.
TEST(CoarseToFine, GoesThroughTheOnlyDoor) {
  CostGrid map = openMap(200, 100);
  Grid<CostGrid::Weight> weights = map.weights();
  for (int row = 0; row < 100; ++row) weights[Cell{72, row}] = CostGrid::kBlocked;
  weights[Cell{72, 91}] = 1;
  const CostGrid walled(weights, map.classes(), {});
  const PlanResult result = planOn(walled, {{60, 3}, {{85, 3}}, false});
  ASSERT_EQ(result.status, Status::FOUND);
  EXPECT_TRUE(std::count(result.cells.begin(), result.cells.end(), (Cell{72, 91})));
  weights[Cell{72, 91}] = CostGrid::kBlocked;
  const CostGrid closed(weights, map.classes(), {});
  EXPECT_EQ(planOn(closed, {{60, 3}, {{85, 3}}, false}).status, Status::UNREACHABLE);
}

TEST(CoarseToFine, TheOpenMapIsSearchedInACorridorAndTheAnswerProven) {
  const CostGrid map = openMap(640, 640);
  const PlanResult result = planOn(map, {{5, 5}, {{630, 610}}, false});
  EXPECT_NEAR(result.lower_bound, result.costValue(), 1e-9 * result.costValue());
  EXPECT_LT(result.statistics.search_bytes, map.geometry().size() * 8);
}

TEST(CoarseToFine, NoPathCostsLessThanTheBound) {
  std::mt19937 random(8);
  int tight = 0;
  int found = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const CostGrid map = test::randomCosts(random, 100, {});
    const PlanRequest request{test::randomCell(random, map.geometry()),
                              {test::randomCell(random, map.geometry())},
                              false};
    if (!map.passable(request.start)) continue;
    const auto least = test::referenceCosts(
        map, request.start)[map.geometry().index(request.goals.front()).value()];
    if (!least) continue;
    const PlanResult result = planOn(map, request, trial % 2 == 0 ? 1.05 : 1000.0);
    ASSERT_EQ(result.status, Status::FOUND);
    EXPECT_LE(result.lower_bound, least->toDouble());
    EXPECT_LE(least->toDouble(), result.costValue() * (1.0 + 1e-12));
    if (request.start != request.goals.front()) {
      EXPECT_GT(result.lower_bound, 0.0);
    }
    ++found;
    if (result.costValue() <= 1.05 * result.lower_bound) ++tight;
  }
  EXPECT_GT(tight, found / 4);
}

TEST(CoarseToFine, ABetterBoundTakesMoreSearch) {
  std::mt19937 random(9);
  std::uint64_t quick = 0;
  std::uint64_t thorough = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const CostGrid map = test::randomCosts(random, 100, {});
    const PlanRequest request{{0, 0}, {{map.geometry().width() - 1, 0}}, false};
    const PlanResult a = planOn(map, request, 1000.0);
    const PlanResult b = planOn(map, request, 1.0);
    if (a.status != Status::FOUND) continue;
    EXPECT_LE(b.costValue(), a.costValue());
    EXPECT_GE(b.lower_bound, a.lower_bound);
    quick += a.statistics.expanded;
    thorough += b.statistics.expanded;
  }
  EXPECT_LT(quick, thorough);
}

}  // namespace
}  // namespace grid_path_planner
