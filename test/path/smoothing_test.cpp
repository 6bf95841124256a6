#include "grid_path_planner/path/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/ascii_map.h"
#include "support/cost_maps.h"

namespace grid_path_planner::path {

using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::CostGrid;
using costmap::SegmentPoint;
using grid::Cell;
using grid::Grid;
using grid::GridGeometry;

namespace {

std::vector<SegmentPoint> centresOf(const std::vector<Cell>& cells) {
  std::vector<SegmentPoint> points;
  for (const Cell cell : cells) points.push_back(SegmentPoint::centreOf(cell));
  return points;
}

SmoothPath smoothOver(const test::AsciiMap& picture, const std::vector<Cell>& cells) {
  return smoothed(*test::costsOf(picture.map), centresOf(cells), StopToken());
}

TEST(Smoothing, TakesAnOpenDiagonalInOneLine) {
  const SmoothPath path = smoothOver(test::AsciiMap({"S....",  //
                                                     ".....",  //
                                                     "....G"}),
                                     {{0, 0}, {1, 0}, {2, 0}, {3, 1}, {4, 2}});
  EXPECT_EQ(path.kept, (std::vector<std::size_t>{0, 4}));
  EXPECT_DOUBLE_EQ(path.cost, std::hypot(4, 2));
}

TEST(Smoothing, KeepsWhatGoesRoundAnObstacle) {
  const SmoothPath path =
      smoothOver(test::AsciiMap({".....",  //
                                 ".###.",  //
                                 "S###G"}),
                 {{0, 2}, {0, 1}, {0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {4, 1}, {4, 2}});
  EXPECT_EQ(path.kept, (std::vector<std::size_t>{0, 2, 6, 8}));
  EXPECT_DOUBLE_EQ(path.cost, 8.0);
}

// The straight line through unknown cells is legal, and costs more.
TEST(Smoothing, KeepsWhatGoesRoundCostlyCells) {
  const SmoothPath path =
      smoothOver(test::AsciiMap({"......",  //
                                 "S????G"}),
                 {{0, 1}, {0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {5, 1}});
  EXPECT_DOUBLE_EQ(path.cost, 3.0 + 2.0 * std::sqrt(2.0));
}

TEST(Smoothing, KeepsASinglePointAndAPathThatIsNotLegal) {
  const test::AsciiMap picture({"S#G"});
  EXPECT_EQ(smoothOver(picture, {{0, 0}}).kept, std::vector<std::size_t>{0});
  EXPECT_EQ(smoothOver(picture, {{0, 0}}).cost, 0.0);
  const SmoothPath through = smoothOver(picture, {{0, 0}, {1, 0}, {2, 0}});
  EXPECT_EQ(through.kept, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(std::isinf(through.cost));
}

TEST(Smoothing, StopsWhenAsked) {
  const Grid<CostGrid::Weight> weights(GridGeometry(2000, 2, 1.0), 1);
  const CostGrid map = test::costMap(weights);
  std::vector<Cell> cells;
  for (int column = 0; column < 2000; ++column) cells.push_back({column, column % 2});
  StopSource source;
  source.cancel();
  EXPECT_THROW(smoothed(map, centresOf(cells), source.token()), Stopped);
}

}  // namespace
}  // namespace grid_path_planner::path
