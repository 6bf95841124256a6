// Which part of the tree the 2-D map holds where it cannot hold all of it.
#include <gtest/gtest.h>

#include <random>

#include "grid_path_planner/mapping/projection.h"
#include "mapping/side_view.h"

namespace grid_path_planner::mapping {
namespace {

using grid::Cell;
using grid::CellRect;
using grid::OccupancyGrid;
using test::voxelKey;

ProjectionOptions limited(int max_cells, double keep_around) {
  ProjectionOptions options;
  options.max_cells = max_cells;
  options.keep_around = keep_around;
  return options;
}

void addSquare(OccupancyBricks& bricks, int x, int y, int side) {
  for (int i = 0; i < side; i += 8)
    for (int j = 0; j < side; j += 8) bricks.setVoxel(voxelKey(x + i, y + j, 0), Voxel::OCCUPIED);
}

void addRay(OccupancyBricks& bricks, int length) {
  for (int i = 0; i < length; ++i) bricks.setVoxel(voxelKey(i, i, 0), Voxel::FREE);
  bricks.setVoxel(voxelKey(length, length, 0), Voxel::OCCUPIED);
}

// 100 occupied, 0 free, -1 unknown, -2 outside; at the voxel's centre, of 1 m.
int valueAt(const OccupancyGrid& grid, int x, int y) {
  const auto cell = grid.geometry().cellAt({x + 0.5, y + 0.5});
  return cell ? grid[*cell] : -2;
}

// A point at 900 m: the grid would have had more than 2^28 cells, every projection threw from then
// on, and the map stayed as it was while diagnostics said OK.
TEST(Extent, AStrayRayIsLeftOutAndTheMapGoesOnChanging) {
  OccupancyBricks bricks(1.0);
  Projection projection(1.0, {});
  addSquare(bricks, 0, 0, 400);
  projection.update(bricks);
  EXPECT_EQ(projection.columnsLeftOut(), 0u);
  addRay(bricks, 32000);
  projection.update(bricks);
  EXPECT_GT(projection.columnsLeftOut(), 0u);
  EXPECT_EQ(valueAt(projection.grid(), 392, 0), 100);
  bricks.setVoxel(voxelKey(5, 6, 0), Voxel::OCCUPIED);
  EXPECT_EQ(projection.update(bricks).cells.width, 1);
  EXPECT_EQ(valueAt(projection.grid(), 5, 6), 100);
}

TEST(Extent, AWholeMapComesBackWhenTheStrayRayIsGone) {
  OccupancyBricks bricks(1.0);
  Projection projection(1.0, limited(10000, 0.0));
  addSquare(bricks, 0, 0, 48);
  addRay(bricks, 1000);
  projection.update(bricks);
  EXPECT_GT(projection.columnsLeftOut(), 0u);
  bricks.clear(1.0);
  addSquare(bricks, 0, 0, 80);
  projection.update(bricks);
  EXPECT_EQ(projection.columnsLeftOut(), 0u);
  EXPECT_EQ(valueAt(projection.grid(), 72, 72), 100);
}

TEST(Extent, WhatLiesAroundTheSensorIsKeptHoweverDenseTheRestIs) {
  OccupancyBricks bricks(1.0);
  Projection projection(1.0, limited(100 * 100, 16.0));
  addSquare(bricks, 0, 0, 80);
  projection.update(bricks);
  projection.setSensor(1000.0, 1000.0);
  bricks.setVoxel(voxelKey(1004, 1000, 0), Voxel::OCCUPIED);
  EXPECT_TRUE(projection.update(bricks).geometry);
  EXPECT_EQ(valueAt(projection.grid(), 1004, 1000), 100);
  EXPECT_EQ(projection.columnsLeftOut(), 100u);
  projection.setSensor(0.0, 0.0);
  EXPECT_TRUE(projection.update(bricks).geometry) << "it moved, and nothing else changed";
  EXPECT_EQ(valueAt(projection.grid(), 0, 0), 100);
}

TEST(Extent, RaysThatStrayWithEveryScanChangeTheGeometrySeldom) {
  OccupancyBricks bricks(1.0);
  Projection projection(1.0, limited(500 * 500, 20.0));
  std::mt19937 random(3);
  std::uniform_int_distribution<int> far(2000, 9000);
  int changes = 0;
  for (int scan = 0; scan < 300; ++scan) {
    bricks.setVoxel(voxelKey(scan, scan / 3, 0), Voxel::OCCUPIED);
    bricks.setVoxel(voxelKey(far(random), -far(random), 0), Voxel::OCCUPIED);
    projection.setSensor(scan, scan / 3);
    changes += projection.update(bricks).geometry;
    EXPECT_EQ(valueAt(projection.grid(), scan, scan / 3), 100);
  }
  EXPECT_LT(changes, 60);
}

TEST(ExtentLaw, WithinTheLimitAndWhatIsInsideIsTheTreeAndTheCountIsRight) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::normal_distribution<double> near(0.0, 60.0);
    OccupancyBricks bricks(1.0);
    Projection projection(1.0, limited(5000 + static_cast<int>(random() % 20000), 10.0));
    std::vector<Cell> occupied;
    for (int i = 0; i < 60; ++i) {
      const double stretch = i % 7 == 0 ? 20.0 : 1.0;
      const Cell cell{static_cast<int>(stretch * near(random)),
                      static_cast<int>(stretch * near(random))};
      occupied.push_back(cell);
      bricks.setVoxel(voxelKey(cell.column, cell.row, 0), Voxel::OCCUPIED);
      if (random() % 3 == 0) projection.setSensor(cell.column, cell.row);
      projection.update(bricks);
      ASSERT_LE(projection.grid().geometry().size(),
                static_cast<std::size_t>(projection.options().max_cells));
    }
    std::size_t inside = 0;
    for (const Cell cell : occupied) {
      const int value = valueAt(projection.grid(), cell.column, cell.row);
      EXPECT_TRUE(value == 100 || value == -2) << value;
      inside += value == 100;
    }
    EXPECT_GT(inside, 0u);
    std::size_t outside = 0;
    for (const BrickColumn column : bricks.columns())
      outside += valueAt(projection.grid(), 8 * column.x - 32768, 8 * column.y - 32768) == -2;
    EXPECT_EQ(projection.columnsLeftOut(), outside);
  }
}

}  // namespace
}  // namespace grid_path_planner::mapping
