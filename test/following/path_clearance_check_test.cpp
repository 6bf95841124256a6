#include "grid_path_planner/following/path_clearance_check.h"

#include <gtest/gtest.h>

#include <random>

#include "support/ascii_map.h"

namespace grid_path_planner::following {

using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

using Polyline = std::vector<Eigen::Vector3d>;

Polyline polyline(const std::vector<std::pair<double, double>>& points) {
  Polyline result;
  for (const auto& p : points) result.emplace_back(p.first, p.second, -3.0);
  return result;
}

const OccupancyGrid& map() {
  static const test::AsciiMap picture({".....",  //
                                       "..#..",  //
                                       ".?..."});
  return picture.map;
}

TEST(PathClearanceCheck, AnOccupiedCellAhead) {
  EXPECT_EQ(firstOccupied(map(), 65, polyline({{0.5, 1.5}, {4.5, 1.5}}), 0.0), (Cell{2, 1}));
  EXPECT_EQ(firstOccupied(map(), 65, polyline({{2.5, 1.5}}), 0.0), (Cell{2, 1}));
}

TEST(PathClearanceCheck, UnknownCellsAndTheOutsideAreFree) {
  EXPECT_EQ(firstOccupied(map(), 65, polyline({{0.5, 2.5}, {4.5, 2.5}}), 0.0), std::nullopt);
  EXPECT_EQ(firstOccupied(map(), 65, polyline({{-1e6, -1e6}, {-5.0, 8.0}}), 0.0), std::nullopt);
  EXPECT_EQ(firstOccupied(map(), 65, {}, 0.0), std::nullopt);
}

TEST(PathClearanceCheck, GrazingAnEdgeOrACornerIsFree) {
  EXPECT_EQ(firstOccupied(map(), 65, polyline({{0.0, 1.0}, {5.0, 1.0}}), 0.0), std::nullopt);
  EXPECT_EQ(firstOccupied(map(), 65, polyline({{1.0, 2.0}, {3.0, 0.0}}), 0.0), std::nullopt);
  EXPECT_EQ(firstOccupied(map(), 65, polyline({{1.01, 2.0}, {3.01, 0.0}}), 0.0), (Cell{2, 1}));
  EXPECT_EQ(firstOccupied(map(), 65, polyline({{1.0, 1.0}, {2.0, 2.0}, {3.0, 3.0}}), 0.0),
            std::nullopt);
}

TEST(PathClearanceCheck, TheRadiusKeepsItsDistance) {
  EXPECT_EQ(firstOccupied(map(), 65, polyline({{0.0, 0.5}, {5.0, 0.5}}), 0.49), std::nullopt);
  EXPECT_EQ(firstOccupied(map(), 65, polyline({{0.0, 0.5}, {5.0, 0.5}}), 0.51), (Cell{2, 1}));
}

TEST(PathClearanceCheck, TheThresholdIsInclusive) {
  OccupancyGrid grey = map();
  grey[{2, 1}] = 70;
  EXPECT_TRUE(firstOccupied(grey, 70, polyline({{2.5, 1.5}}), 0.0));
  EXPECT_FALSE(firstOccupied(grey, 71, polyline({{2.5, 1.5}}), 0.0));
}

// A path that is free by the check has no occupied cell at any of its points, and one that is not
// has.
TEST(PathClearanceCheckLaw, AgreesWithPointsAlongThePath) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.0, 21.0);
  for (int trial = 0; trial < 300; ++trial) {
    OccupancyGrid grid(GridGeometry(40, 40, 0.5, {0.0, 0.0, 0.2 * (trial % 7)}));
    for (auto& value : grid.values()) value = random() % 60 == 0 ? 100 : 0;
    const Polyline line =
        polyline({{place(random), place(random)}, {place(random), place(random)}});
    bool met = false;
    for (int i = 0; i <= 20000; ++i) {
      const Eigen::Vector3d point = line[0] + (line[1] - line[0]) * (i / 20000.0);
      const auto cell = grid.geometry().cellAt(point.head<2>());
      met = met || (cell && grid[*cell] == 100);
    }
    const auto found = firstOccupied(grid, 65, line, 0.0);
    EXPECT_TRUE(found || !met) << trial;
    EXPECT_TRUE(!found || grid[*found] == 100) << trial;
    if (!met && found) {  // met between two of the points: a corner, hardly touched
      EXPECT_TRUE(firstOccupied(grid, 65, line, 0.01)) << trial;
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::following
