#include "grid_path_planner/mapping/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "mapping/side_view.h"
#include "support/error_text.h"
#include "support/option_laws.h"

namespace grid_path_planner::mapping {

using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

using test::errorText;
using test::rowOf;
using test::sideView;
using test::voxelKey;

ProjectionOptions band(double min_z, double max_z) {
  ProjectionOptions options;
  options.min_z = min_z;
  options.max_z = max_z;
  return options;
}

ProjectionOptions aboveSeabed(double min_z, double max_z, double max_slope, double radius = 20.0) {
  ProjectionOptions options = band(min_z, max_z);
  options.reference = ProjectionReference::SEABED;
  options.seabed_max_slope = max_slope;
  options.seabed_radius = radius;
  return options;
}

std::string projected(OccupancyBricks bricks, const ProjectionOptions& options, int y = 0) {
  Projection projection(1.0, options);
  projection.update(bricks);
  return rowOf(projection.grid(), y);
}

TEST(Projection, OneOccupiedVoxelMakesTheCellOccupiedOneFreeVoxelMakesItFree) {
  EXPECT_EQ(projected(sideView({"#. . #",  //
                                ".#.  #"}),
                      {}),
            "##..?#");
}

TEST(Projection, OnlyTheBandCountsAndTouchingItIsNotEnough) {
  const OccupancyBricks world = sideView({"#...",  // z 2..3
                                          ".#..",  // z 1..2
                                          "..#."});
  EXPECT_EQ(projected(world, band(1.0, 2.0)), ".#..");
  EXPECT_EQ(projected(world, band(1.5, 2.0)), ".#..");
  EXPECT_EQ(projected(world, band(0.5, 1.5)), ".##.");
  EXPECT_EQ(projected(world, band(2.0, 9.0)), "#...");
  EXPECT_EQ(projected(world, band(3.0, 9.0)), "");
}

TEST(Projection, BandEdgesOnTheLatticeAreNotMissedForRounding) {
  OccupancyBricks bricks(0.05);
  for (int z = 0; z < 2000; ++z) bricks.setVoxel(voxelKey(z, 0, z), Voxel::OCCUPIED);
  for (int z = 0; z < 2000; ++z) {
    Projection projection(0.05, band(z * 0.05, (z + 1) * 0.05));
    bricks.setVoxel(voxelKey(z, 0, z), Voxel::OCCUPIED);
    projection.update(bricks);
    int occupied = 0;
    for (const std::int8_t value : projection.grid().values()) occupied += value == 100;
    ASSERT_EQ(occupied, 1) << "voxel " << z;
  }
}

// octomap_mapping PR#127: setting the band of the 2-D map changed the 3-D map.
TEST(Projection, OM127TheBandNeverChangesTheTree) {
  OccupancyBricks bricks = sideView({"#.", ".#"});
  Projection projection(1.0, band(0.0, 1.0));
  projection.update(bricks);
  EXPECT_EQ(rowOf(projection.grid(), 0), ".#");
  projection.setOptions(band(1.0, 2.0));
  projection.update(bricks);
  EXPECT_EQ(rowOf(projection.grid(), 0), "#.");
  EXPECT_EQ(bricks.voxel(voxelKey(0, 0, 1)), Voxel::OCCUPIED);
  EXPECT_EQ(bricks.voxel(voxelKey(1, 0, 0)), Voxel::OCCUPIED);
}

// octomap#183, octomap_mapping#62, #110: what was removed stayed in the map.
TEST(Projection, O183AVoxelFreedInTheTreeIsFreedInTheNextGrid) {
  OccupancyBricks bricks = sideView({"..#."});
  Projection projection(1.0, {});
  projection.update(bricks);
  bricks.setVoxel(voxelKey(2, 0, 0), Voxel::FREE);
  const ProjectionChange change = projection.update(bricks);
  EXPECT_EQ(rowOf(projection.grid(), 0), "....");
  EXPECT_FALSE(change.geometry);
  EXPECT_EQ(change.cells, (CellRect{2, 0, 1, 1}));
}

// octomap_mapping#85, PR#34: an empty tree crashed, a reset gave no answer.
TEST(Projection, OM85AnEmptyTreeAndAResetGiveAValidClearedGrid) {
  OccupancyBricks bricks(1.0);
  Projection projection(1.0, {});
  const ProjectionChange first = projection.update(bricks);
  EXPECT_FALSE(first.geometry);
  EXPECT_EQ(projection.grid().values(), (std::vector<std::int8_t>{-1}));

  test::drawSideView(bricks, {"..#"});
  EXPECT_TRUE(projection.update(bricks).geometry);
  const GridGeometry geometry = projection.grid().geometry();
  bricks.clear(1.0);
  const ProjectionChange cleared = projection.update(bricks);
  EXPECT_EQ(cleared.cells, (CellRect{0, 0, 3, 1}));
  EXPECT_EQ(projection.grid(), OccupancyGrid(geometry, -1));
}

// octomap_server2#26: the grid does not grow with the tree.
TEST(Projection, OS26TheGridGrowsAndNothingShiftsInTheWorld) {
  OccupancyBricks bricks(0.05);
  Projection projection(0.05, {});
  const std::vector<std::pair<int, int>> voxels = {{3, 5},    {-40, 7},  {900, -3},
                                                   {-5, 700}, {8, -999}, {9000, -1}};
  int seen_voxels = 0;
  for (const auto& [x, y] : voxels) {
    bricks.setVoxel(voxelKey(x, y, 0), Voxel::OCCUPIED);
    projection.update(bricks);
    for (const auto& [x2, y2] : voxels) {
      const auto cell = projection.grid().geometry().cellAt({(x2 + 0.5) * 0.05, (y2 + 0.5) * 0.05});
      const bool seen = bricks.voxel(voxelKey(x2, y2, 0)) == Voxel::OCCUPIED;
      EXPECT_EQ(cell && projection.grid()[*cell] == 100, seen) << x2 << ", " << y2;
    }
    const auto& values = projection.grid().values();
    EXPECT_EQ(std::count(values.begin(), values.end(), 100), ++seen_voxels);
  }
}

TEST(Projection, AVehicleThatExploresChangesTheGeometrySeldom) {
  OccupancyBricks bricks(0.05);
  Projection projection(0.05, {});
  int changes = 0;
  for (int x = 0; x < 2000; ++x) {
    bricks.setVoxel(voxelKey(x, x / 3, 0), Voxel::FREE);
    changes += projection.update(bricks).geometry;
  }
  EXPECT_LT(changes, 40);
}

TEST(Projection, BoundsFixTheExtentWhateverIsSeen) {
  ProjectionOptions options;
  options.bounds = {-2.65, -12.9, 15.65, 5.2};
  Projection projection(0.05, options);
  const GridGeometry expected(366, 362, 0.05, {-53 * 0.05, -258 * 0.05, 0.0});
  EXPECT_EQ(projection.grid(), OccupancyGrid(expected, -1));
  OccupancyBricks bricks(0.05);
  for (const int x : {-20000, -53, 0, 312, 313, 20000})
    bricks.setVoxel(voxelKey(x, 0, 0), Voxel::OCCUPIED);
  const ProjectionChange change = projection.update(bricks);
  EXPECT_FALSE(change.geometry);
  EXPECT_EQ(change.cells, (CellRect{0, 258, 366, 1}));
  EXPECT_EQ(projection.grid().geometry(), expected);
}

TEST(Projection, BoundsCanComeAndGo) {
  OccupancyBricks bricks = sideView({"#.#.#"});
  ProjectionOptions options;
  Projection projection(1.0, options);
  projection.update(bricks);
  options.bounds = {1.0, 0.0, 4.0, 1.0};
  projection.setOptions(options);
  EXPECT_TRUE(projection.update(bricks).geometry);
  EXPECT_EQ(projection.grid(),
            OccupancyGrid(GridGeometry(3, 1, 1.0, {1.0, 0.0, 0.0}), {0, 100, 0}));
  projection.setOptions({});
  EXPECT_TRUE(projection.update(bricks).geometry);
  EXPECT_EQ(rowOf(projection.grid(), 0), "#.#.#");
}

TEST(Projection, TheVehiclesBandMovesWithItByMoreThanAVoxel) {
  OccupancyBricks bricks = sideView({"#...",  // z 3..4
                                     ".#..",  //
                                     "..#.",  //
                                     "...#"});
  ProjectionOptions options = band(-0.5, 0.5);
  options.reference = ProjectionReference::VEHICLE;
  Projection projection(1.0, options);
  projection.setVehicleHeight(2.5);
  projection.update(bricks);
  EXPECT_EQ(rowOf(projection.grid(), 0), ".#..");
  projection.setVehicleHeight(3.4);
  EXPECT_TRUE(projection.update(bricks).cells.empty());
  projection.setVehicleHeight(3.51);
  EXPECT_EQ(projection.update(bricks).cells, (CellRect{0, 0, 2, 1}));
  EXPECT_EQ(rowOf(projection.grid(), 0), "#...");
}

// octomap#317, octomap_mapping#31: the ground becomes an obstacle.
TEST(Projection, O317ARampIsNoObstacleAWallOnItIs) {
  const OccupancyBricks world = sideView({"......#.....",  //
                                          "......#.....",  //
                                          "......#.....",  //
                                          "......#.....",  //
                                          "......#...##",  //
                                          "......#.##  ",  //
                                          "......##    ",  //
                                          "....##      ",  //
                                          "..##        ",  //
                                          "##          "});
  EXPECT_EQ(projected(world, aboveSeabed(1.6, 9.0, 0.5)), "......#.....");
  EXPECT_EQ(projected(world, band(1.0, 9.0)), "..##########") << "what a fixed band sees";
}

TEST(Projection, AStepHigherThanTheSlopeAllowsIsAnObstacle) {
  const OccupancyBricks world = sideView({"       #####",  //
                                          ".......#    ",  //
                                          ".......#    ",  //
                                          ".......#    ",  //
                                          "#######     "});
  EXPECT_EQ(projected(world, aboveSeabed(0.6, 3.4, 0.5)), ".......#####");
  EXPECT_EQ(projected(world, aboveSeabed(0.6, 3.4, 0.5, 2.0)), ".......###")
      << "farther than 2 m from the foot of the step the plateau is ground itself";
}

TEST(Projection, AHullAboveTheSeabedIsNotTakenForSeabed) {
  const std::vector<std::string> lines = {"   ######   ",  //
                                          "............",  //
                                          "............",  //
                                          "............",  //
                                          "###     ####"};
  EXPECT_EQ(projected(sideView(lines), aboveSeabed(0.6, 9.0, 0.5)), "...######...")
      << "its own seabed was not seen, but that beside it was";
  EXPECT_EQ(projected(sideView(lines), aboveSeabed(0.6, 2.0, 0.5)), "............")
      << "a band below the hull";
  EXPECT_EQ(projected(sideView({lines.begin(), lines.end() - 1}), aboveSeabed(0.6, 9.0, 0.5)),
            "???######")
      << "no seabed seen: an obstacle is one, and nothing is free";
}

TEST(Projection, OptionsHoldTheirLaws) {
  test::expectOptionLaws<ProjectionOptions>();
}

TEST(Projection, OptionsThatHoldNothingAreRefused) {
  EXPECT_TRUE(
      test::contains(errorText([] { Projection(1.0, band(2.0, 2.0)); }), "min_z below its max_z"));
  ProjectionOptions options;
  options.bounds = {1.0, 2.0, 3.0, 2.0};
  EXPECT_TRUE(test::contains(errorText([&] { Projection(1.0, options); }), "projection_bounds"));
  options.bounds = {-1e5, -1e5, 1e5, 1e5};
  EXPECT_TRUE(test::contains(errorText([&] { Projection(1.0, options); }), "cells, at most"));
}

}  // namespace
}  // namespace grid_path_planner::mapping
