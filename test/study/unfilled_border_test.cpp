#include "study/unfilled_border.h"

#include <gtest/gtest.h>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "support/cost_maps.h"

namespace grid_path_planner::study {

using costmap::CostGrid;
using costmap::CostmapOptions;
using costmap::KernelRule;
using grid::Cell;
using grid::GridGeometry;
using grid::Occupancy;
using grid::OccupancyGrid;

namespace {

const GridGeometry kPublished(366, 362, 0.05);

int blocksOfRow(int kernel, int row) {
  int blocks = 0;
  for (int column = 0; column < 366; column += kernel)
    blocks += inUnfilledBlock({column, row}, kPublished, kernel) ? 1 : 0;
  return blocks;
}

// The published figures, its rows being our columns: at kernel 5 row 73 and column 72, at kernel 7
// row 52, at kernel 3 none.
TEST(UnfilledBorder, IsThatOfTheOriginal) {
  EXPECT_TRUE(inUnfilledBlock({73 * 5, 0}, kPublished, 5));
  EXPECT_FALSE(inUnfilledBlock({73 * 5 - 1, 0}, kPublished, 5)) << "block 72 is whole";
  EXPECT_TRUE(inUnfilledBlock({0, 72 * 5}, kPublished, 5));
  EXPECT_EQ(blocksOfRow(5, 0), 1);
  EXPECT_EQ(blocksOfRow(5, 361), 74) << "all of the last row";
  EXPECT_TRUE(inUnfilledBlock({52 * 7, 0}, kPublished, 7));
  EXPECT_EQ(blocksOfRow(7, 361), 1) << "the middle of row 51 lies in the map";
  EXPECT_EQ(blocksOfRow(3, 361), 0);
}

TEST(UnfilledBorder, IsFreeWhateverTheMapHolds) {
  const OccupancyGrid unknown(kPublished, -1);
  CostmapOptions options;
  options.kernel = 5;
  options.kernel_rule = KernelRule::FILTER2D;
  const auto costs = test::costsOf(withUnfilledBorder(unknown, 5), options);
  for (const Cell block : test::cellsOf(*costs))
    EXPECT_EQ(costs->occupancy(block),
              block.column == 73 || block.row == 72 ? Occupancy::FREE : Occupancy::UNKNOWN)
        << block;
}

TEST(UnfilledBorder, ALineThroughItIsCountedByBlocks) {
  path::Path path;
  const auto add = [&path](int column, int row) {
    path::Pose pose;
    pose.position << kPublished.centre({column, row}), 0.0;
    path.poses.push_back(pose);
  };
  add(362, 2);   // block 72, filled
  add(365, 2);   // block 73
  add(365, 3);   // the same block
  add(365, 7);   // the next one
  add(362, 12);  // filled
  EXPECT_EQ(unfilledBlocksOf(path, kPublished, 5), 2u);
  EXPECT_EQ(unfilledBlocksOf(path, kPublished, 3), 0u);
}

}  // namespace
}  // namespace grid_path_planner::study
