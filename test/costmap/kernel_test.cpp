#include "costmap/kernel.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "support/ascii_map.h"
#include "support/cost_maps.h"
#include "support/random_map.h"

namespace grid_path_planner::costmap {

using base::StopToken;
using grid::Cell;
using grid::CellIndex;
using grid::GridGeometry;
using grid::Occupancy;
using grid::OccupancyGrid;
using test::costsOf;

namespace {

CostmapOptions withKernel(int kernel, KernelRule rule = KernelRule::CONSERVATIVE) {
  CostmapOptions options;
  options.kernel = kernel;
  options.kernel_rule = rule;
  return options;
}

TEST(Kernel, TheOriginalStudysMapHasItsSizes) {
  const OccupancyGrid map(GridGeometry(366, 362, 0.05));
  const auto sizeAt = [&map](int kernel) {
    const GridGeometry blocks = costsOf(map, withKernel(kernel))->geometry();
    return std::make_pair(blocks.width(), blocks.height());
  };
  EXPECT_EQ(sizeAt(1), std::make_pair(366, 362));
  EXPECT_EQ(sizeAt(3), std::make_pair(122, 121));
  EXPECT_EQ(sizeAt(5), std::make_pair(74, 73));
  EXPECT_EQ(sizeAt(7), std::make_pair(53, 52));
}

TEST(Kernel, ConservativeKeepsTheWorstCell) {
  const auto costs = costsOf(test::AsciiMap({"...#",  //
                                             ".?.."})
                                 .map,
                             withKernel(2));
  EXPECT_EQ(costs->weight({0, 0}), 50);
  EXPECT_EQ(costs->occupancy({0, 0}), Occupancy::UNKNOWN);
  EXPECT_FALSE(costs->passable({1, 0}));
  EXPECT_EQ(costs->occupancy({1, 0}), Occupancy::OCCUPIED);
}

TEST(Kernel, ABlockAtTheBorderIsJudgedByTheCellsItHas) {
  const auto costs = costsOf(test::AsciiMap({"..#"}).map, withKernel(2));
  EXPECT_TRUE(costs->passable({0, 0}));
  EXPECT_FALSE(costs->passable({1, 0}));
  EXPECT_EQ(costs->waypoint({0, 0}), Eigen::Vector2d(1.0, 0.5));
  EXPECT_EQ(costs->waypoint({1, 0}), Eigen::Vector2d(2.5, 0.5));
}

// The published rule, and why it is not safe: three unknown cells outweigh an obstacle, and one
// obstacle among three unknown ones counts as nothing.
TEST(Kernel, Filter2dIsTheSignOfTheSum) {
  const auto classOf = [](const std::vector<std::string>& lines) {
    return costsOf(test::AsciiMap(lines).map, withKernel(2, KernelRule::FILTER2D))
        ->occupancy({0, 0});
  };
  EXPECT_EQ(classOf({"#.", ".."}), Occupancy::OCCUPIED);
  EXPECT_EQ(classOf({"#?", ".?"}), Occupancy::OCCUPIED);
  EXPECT_EQ(classOf({"#?", "??"}), Occupancy::FREE);
  EXPECT_EQ(classOf({".?", ".."}), Occupancy::UNKNOWN);
  EXPECT_EQ(classOf({"..", ".."}), Occupancy::FREE);
}

// navigation2#2686: downsampling that spoils the source map, or applies when disabled.
TEST(KernelLaw, OneChangesNothingAndNoneChangesTheMap) {
  std::mt19937 random(2686);
  for (int trial = 0; trial < 20; ++trial) {
    const OccupancyGrid map = test::randomOccupancy(random, 30, 0.2, 0.2);
    const OccupancyGrid before = map;
    CostmapBuilder builder(withKernel(1));
    builder.setMap(std::make_shared<const OccupancyGrid>(map));
    EXPECT_EQ(builder.downsampled(StopToken()), builder.fullResolution(StopToken()));
    for (int kernel = 2; kernel <= 8; ++kernel) costsOf(map, withKernel(kernel));
    EXPECT_EQ(map, before);
  }
}

// navigation#223, navigation2#3285: "don't cross unknown" ignored after downsampling.
TEST(KernelLaw, AnOpenBlockHasOnlyPassableCellsAndTheLargestOfTheirWeights) {
  std::mt19937 random(223);
  for (int trial = 0; trial < 60; ++trial) {
    const OccupancyGrid map = test::randomOccupancy(random, 40, 0.03, 0.05);
    CostmapOptions options = withKernel(1 + trial % 8);
    options.unknown_is_passable = trial % 2 == 0;
    options.radius = trial % 3 * 0.6;
    options.decay = trial % 4 * 0.5;
    CostmapBuilder builder(options);
    builder.setMap(std::make_shared<const OccupancyGrid>(map));
    const auto fine = builder.fullResolution(StopToken());
    const auto blocks = builder.downsampled(StopToken());
    std::vector<int> largest(blocks->geometry().size(), 0);
    std::vector<bool> blocked(blocks->geometry().size(), false);
    for (std::uint32_t i = 0; i < map.values().size(); ++i) {
      const Cell cell = map.geometry().cell(CellIndex(i));
      const std::uint32_t block =
          blocks->geometry()
              .index({cell.column / options.kernel, cell.row / options.kernel})
              .value();
      largest[block] = std::max<int>(largest[block], fine->weight(cell));
      if (!fine->passable(cell)) blocked[block] = true;
    }
    for (std::uint32_t i = 0; i < largest.size(); ++i)
      ASSERT_EQ(blocks->weights().values()[i], blocked[i] ? 0 : largest[i]) << "trial " << trial;
  }
}

}  // namespace
}  // namespace grid_path_planner::costmap
