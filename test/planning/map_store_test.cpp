// Planners that share a map: each plans as if it had the newest map to itself, whenever it asks.
#include "planning/map_store.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>

#include "grid_path_planner/planning/path_planner.h"
#include "support/random_map.h"

namespace grid_path_planner::planning {

using base::Status;
using base::Stopped;
using base::StopSource;
using base::StopToken;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

std::shared_ptr<const OccupancyGrid> shared(const OccupancyGrid& map) {
  return std::make_shared<const OccupancyGrid>(map);
}

PoseRequest requestBetween(const GridGeometry& geometry, Cell start, Cell goal) {
  PoseRequest request;
  request.start.position.head<2>() = geometry.centre(start);
  request.goal.position.head<2>() = geometry.centre(goal);
  return request;
}

PlannerOptions optionsOf(int trial, const std::string& planner) {
  PlannerOptions options;
  options.planner = planner;
  options.costmap.kernel = 1 + trial % 3;
  options.costmap.radius = trial % 2 * 1.6;
  options.costmap.decay = trial % 4 * 0.3;
  options.costmap.unknown_is_passable = trial % 5 != 0;
  return options;
}

// Draws over a few cells, or over many all over the map, and gives the rectangles.
std::vector<CellRect> edit(std::mt19937& random, OccupancyGrid& map) {
  std::vector<CellRect> changed;
  const unsigned places = random() % 5 == 0 ? 100 : 1 + random() % 3;
  for (unsigned i = 0; i < places; ++i) {
    const Cell cell = test::randomCell(random, map.geometry());
    const std::int8_t values[] = {0, 100, 100, -1};
    map[cell] = values[random() % 4];
    changed.push_back({cell.column, cell.row, 1, 1});
  }
  return changed;
}

void expectAsOnAFreshMap(PathPlanner& planner, const OccupancyGrid& map,
                         const PoseRequest& request) {
  PathPlanner fresh(planner.options());
  fresh.setMap(shared(map));
  const Plan expected = fresh.plan(request);
  const Plan plan = planner.plan(request);
  ASSERT_EQ(plan.status, expected.status);
  ASSERT_EQ(plan.cost, expected.cost);
  ASSERT_EQ(*planner.map(), map);
  const auto fresh_costs = fresh.downsampledCosts(StopToken());
  const auto costs = planner.downsampledCosts(StopToken());
  ASSERT_EQ(costs->weights(), fresh_costs->weights());
  ASSERT_EQ(costs->classes(), fresh_costs->classes());
}

// One plans at each change, one now and then, one misses more of them than are remembered.
TEST(MapStoreLaw, PlannersThatMissChangesPlanAsOnAFreshMap) {
  std::mt19937 random(14);
  for (int trial = 0; trial < 24; ++trial) {
    OccupancyGrid map = test::randomOccupancy(random, 40, 0.05, 0.05);
    const auto store = std::make_shared<MapStore>();
    store->setMap(shared(map), "map");
    std::vector<std::unique_ptr<PathPlanner>> planners;
    for (const char* name : {"weighted_jump_point", "incremental_a_star", "a_star"})
      planners.push_back(std::make_unique<PathPlanner>(store, optionsOf(trial, name)));
    for (int round = 0; round < 40; ++round) {
      if (random() % 30 == 0) {
        map = test::randomOccupancy(random, 40, 0.05, 0.05);
        store->setMap(shared(map), "map");
      } else {
        const std::vector<CellRect> changed = edit(random, map);
        store->updateMap(shared(map), changed);
      }
      for (std::size_t i = 0; i < planners.size(); ++i) {
        const int every[] = {1, 5, static_cast<int>(grid::ChangeLog<>::kMost) + 3};
        if (round % every[i] != 0) continue;
        SCOPED_TRACE("trial " + std::to_string(trial) + " round " + std::to_string(round) + ' ' +
                     planners[i]->options().planner);
        if (random() % 2 == 0) planners[i]->makeReadyForChanges(StopToken());
        planners[i]->takeMap();
        expectAsOnAFreshMap(*planners[i], map,
                            requestBetween(map.geometry(), test::randomCell(random, map.geometry()),
                                           test::randomCell(random, map.geometry())));
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(MapStore, OneCostmapServesAllOfTheSameOptions) {
  const auto store = std::make_shared<MapStore>();
  OccupancyGrid map(GridGeometry(30, 20, 1.0), 0);
  PathPlanner a(store), b(store);
  a.takeMap();
  EXPECT_FALSE(a.hasMap());
  store->setMap(shared(map), "odom");
  for (PathPlanner* each : {&a, &b}) each->takeMap();
  EXPECT_EQ(a.frameId(), "odom");
  EXPECT_EQ(a.fullResolutionCosts(StopToken()), b.fullResolutionCosts(StopToken()));
  map[Cell{3, 3}] = 100;
  store->updateMap(shared(map), {{3, 3, 1, 1}});
  const auto costs = b.fullResolutionCosts(StopToken());
  EXPECT_EQ(a.fullResolutionCosts(StopToken()), costs);
  EXPECT_FALSE(costs->passable({3, 3}));
  PlannerOptions wider;
  wider.costmap.radius = 2.0;
  b.setOptions(wider);
  EXPECT_FALSE(b.fullResolutionCosts(StopToken())->passable({5, 3}));
  EXPECT_TRUE(a.fullResolutionCosts(StopToken())->passable({5, 3}));
}

// Poses of a request are in the frame that was asked for before: the map must not change it meanwhile.
TEST(MapStore, AMapOfAnotherFrameWaitsForTakeMap) {
  const auto store = std::make_shared<MapStore>();
  store->setMap(shared(OccupancyGrid(GridGeometry(30, 20, 1.0), 0)), "map");
  PathPlanner planner(store);
  planner.takeMap();
  store->setMap(shared(OccupancyGrid(GridGeometry(9, 9, 1.0), 0)), "odom");
  EXPECT_EQ(planner.downsampledCosts(StopToken())->geometry().width(), 30);
  EXPECT_EQ(planner.frameId(), "map");
  planner.takeMap();
  EXPECT_EQ(planner.downsampledCosts(StopToken())->geometry().width(), 9);
  EXPECT_EQ(planner.frameId(), "odom");
}

// Maps of 4000x4000 cells at 5 Hz: with a costmap for each, four clients that waited for one another
// were answered after seconds.
TEST(MapStore, WhoWaitedIsContentWithTheMapOfWhenHeCame) {
  const auto store = std::make_shared<MapStore>();
  EXPECT_EQ(store->revision(), 0u);
  OccupancyGrid map(GridGeometry(30, 20, 1.0), 0);
  store->setMap(shared(map), "map");
  PathPlanner planner(store);
  const auto change = [&](Cell cell) {
    map[cell] = 100;
    store->updateMap(shared(map), {{cell.column, cell.row, 1, 1}});
    return store->revision();
  };
  const std::uint64_t came = change({3, 3});
  planner.takeMap();
  const auto made = planner.downsampledCosts(StopToken());
  change({4, 4});
  planner.takeMap(came);
  EXPECT_EQ(planner.downsampledCosts(StopToken()), made);
  EXPECT_EQ((*planner.map())[Cell({4, 4})], 0) << "the map of these costs";
  planner.takeMap(came + 1);
  EXPECT_FALSE(planner.downsampledCosts(StopToken())->passable({4, 4}));
  change({5, 5});
  planner.takeMap();
  EXPECT_FALSE(planner.downsampledCosts(StopToken())->passable({5, 5}));
}

TEST(MapStore, AStoppedCostmapIsGoneOnWith) {
  MapStore store;
  OccupancyGrid map(GridGeometry(400, 400, 1.0), 0);
  store.setMap(shared(map), "map");
  costmap::CostmapOptions options;
  options.radius = 3.0;
  const auto costmap = store.series()->costmap(options);
  StopSource source;
  source.cancel();
  EXPECT_THROW(costmap->newest(source.token()), Stopped);
  const auto before = costmap->newest(StopToken()).costs;
  for (int row = 0; row < 400; row += 20) map[Cell{row, row}] = 100;
  store.updateMap(shared(map), {map.geometry().rect()});
  EXPECT_THROW(costmap->newest(source.token()), Stopped);
  const auto after = costmap->newest(StopToken()).costs;
  EXPECT_TRUE(before.downsampled->passable({20, 20}));
  EXPECT_FALSE(after.downsampled->passable({22, 20}));
  EXPECT_TRUE(after.downsampled_changes.since(before.downsampled->revision()));
}

// The vehicle's lane and one that answers questions, while maps come.
TEST(MapStore, ThreadsPlanWhileTheMapChanges) {
  const auto store = std::make_shared<MapStore>();
  OccupancyGrid map(GridGeometry(80, 80, 1.0), 0);
  store->setMap(shared(map), "map");
  std::atomic<bool> done{false};
  const auto plan = [&](const char* name) {
    PathPlanner planner(store, optionsOf(3, name));
    while (!done) {
      planner.takeMap();
      const PoseRequest request = requestBetween(planner.map()->geometry(), {1, 1}, {78, 78});
      const Plan answer = planner.plan(request);
      ASSERT_TRUE(answer.found()) << answer.message;
      for (const path::Pose& pose : answer.path.poses) {
        const auto cell = planner.map()->geometry().cellAt(pose.position.head<2>());
        ASSERT_NE((*planner.map())[*cell], 100);
      }
    }
  };
  std::thread vehicle(plan, "weighted_jump_point"), questions(plan, "incremental_a_star");
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    const Cell cell{int(10 + 10 * (random() % 7)), int(10 + 10 * (random() % 7))};
    map[cell] = static_cast<std::int8_t>(map[cell] == 100 ? 0 : 100);
    store->updateMap(shared(map), {{cell.column, cell.row, 1, 1}});
    if (i % 10 == 0) std::this_thread::yield();
  }
  done = true;
  vehicle.join();
  questions.join();
}

}  // namespace
}  // namespace grid_path_planner::planning
