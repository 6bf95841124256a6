// What makes searches faster gives its memory to searches that would be refused for want of it.
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "grid_path_planner/planners/planner_factory.h"
#include "planners/astar/bucket_search.h"
#include "planning/multi_resolution_planner.h"

namespace grid_path_planner::planning {
namespace {

using base::Status, base::StopToken;
using grid::Cell, grid::GridGeometry;

constexpr int kSide = 800;
constexpr int kKernel = 4;

// Obstacles, one of which blocks the block of cell (0, 0).
CostmapPair costmapsOfObstacles() {
  std::mt19937 random(3);
  auto map = std::make_shared<grid::OccupancyGrid>(GridGeometry(kSide, kSide, 0.05));
  for (auto& cell : map->values()) cell = 0;
  for (int i = 0; i < 40; ++i) {
    const int left = 20 + static_cast<int>(random() % (kSide - 120));
    const int low = 20 + static_cast<int>(random() % (kSide - 120));
    for (int row = low; row < low + 60; ++row)
      for (int column = left; column < left + 40; ++column) (*map)[Cell{column, row}] = 100;
  }
  (*map)[Cell{1, 2}] = 100;
  costmap::CostmapOptions options;
  options.kernel = kKernel;
  options.decay = 0.2;
  costmap::CostmapBuilder builder(options);
  builder.setMap(map);
  return {builder.fullResolution(StopToken()), builder.downsampled(StopToken()),
          builder.fullResolutionChanges(), builder.downsampledChanges()};
}

class OptionalMemory : public testing::Test {
 protected:
  OptionalMemory() : planner_("weighted_jump_point", options(), planners::makePlanner) {}

  static planners::SearchOptions options() {
    planners::SearchOptions options;
    options.landmarks = 4;
    return options;
  }

  // To the far corner.
  Status planFrom(Cell start) {
    return planner_.find(start, {kSide - 5, kSide - 5}, false, false, StopToken()).plan.status;
  }

  // Plans with idle time after each until they have paid for tables. Returns the bytes of all.
  std::size_t planUntilThereAreTables() {
    planner_.prepare(maps_, StopToken());
    planner_.finishBackgroundWork(StopToken());
    const std::size_t before = planner_.bytes();
    const std::size_t tables = 16 * maps_.downsampled->geometry().size();
    for (int plans = 0; plans < 2000 && planner_.bytes() < before + tables; ++plans) {
      planFrom({10, 10});
      planner_.finishBackgroundWork(StopToken());
    }
    EXPECT_GE(planner_.bytes(), before + tables);
    return planner_.bytes();
  }

  const CostmapPair maps_ = costmapsOfObstacles();
  MultiResolutionPlanner planner_;
};

// Seen: INVALID_REQUEST after some hundred plans, FOUND before them.
TEST_F(OptionalMemory, GoesWhereAnEndLiesInABlockedBlock) {
  const std::size_t with_tables = planUntilThereAreTables();
  planner_.limitMemory(with_tables - 1000 +
                       planners::BucketSearch::bytesFor(maps_.full_resolution->geometry()));
  EXPECT_EQ(planFrom({0, 0}), Status::FOUND);
  EXPECT_LT(planner_.bytes(),
            with_tables + planners::BucketSearch::bytesFor(maps_.full_resolution->geometry()));
}

TEST_F(OptionalMemory, GoesWhereNothingIsLeft) {
  const std::size_t with_tables = planUntilThereAreTables();
  planner_.releaseOptionalMemory();
  EXPECT_LE(planner_.bytes(), with_tables - 16 * maps_.downsampled->geometry().size());
  EXPECT_EQ(planFrom({10, 10}), Status::FOUND);
}

}  // namespace
}  // namespace grid_path_planner::planning
