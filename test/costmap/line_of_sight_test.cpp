#include "grid_path_planner/costmap/line_of_sight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>

#include "support/cost_maps.h"
#include "support/random_map.h"

namespace grid_path_planner::costmap {

using grid::Cell;
using grid::CellIndex;
using grid::Grid;
using grid::GridGeometry;
using test::costsOf;

namespace {

bool legal(const CostGrid& map, double x0, double y0, double x1, double y1) {
  return lineOfSight(map, SegmentPoint::nearest({x0, y0}), SegmentPoint::nearest({x1, y1}));
}

TEST(Segment, MeetsNoBlockedInterior) {
  const auto map = costsOf({"...",  //
                            ".#.",  //
                            "..."});
  EXPECT_TRUE(legal(*map, 0.5, 0.5, 2.5, 0.5));
  EXPECT_FALSE(legal(*map, 0.5, 1.5, 2.5, 1.5));
  EXPECT_FALSE(legal(*map, 0.5, 0.5, 2.5, 2.5));
  EXPECT_FALSE(legal(*map, 0.5, 0.5, 1.5, 1.5));
}

TEST(Segment, GrazingACornerIsLegal) {
  const auto map = costsOf({".#",  //
                            ".."});
  EXPECT_TRUE(legal(*map, 0.5, 0.5, 1.5, 1.5));
  EXPECT_TRUE(legal(*map, 0.0, 0.0, 2.0, 2.0));
}

TEST(Segment, DoesNotSqueezeBetweenDiagonalNeighbours) {
  const auto map = costsOf({".#",  //
                            "#."});
  EXPECT_FALSE(legal(*map, 0.5, 0.5, 1.5, 1.5));
  EXPECT_FALSE(legal(*map, 0.5, 0.5, 1.0, 1.0));  // an end in the pinch is in it too
}

TEST(Segment, RunsAlongAWallButNotBetweenTwo) {
  const auto wall = costsOf({"....",  //
                             "####"});
  EXPECT_TRUE(legal(*wall, 0.0, 1.0, 4.0, 1.0));
  const auto slit = costsOf({"####",  //
                             "####"});
  EXPECT_FALSE(legal(*slit, 0.5, 1.0, 3.5, 1.0));
  const auto crossing = costsOf({"##..",  //
                                 "..##"});
  EXPECT_FALSE(legal(*crossing, 0.5, 1.0, 3.5, 1.0));
}

TEST(Segment, OutsideTheMapIsBlocked) {
  const auto map = costsOf({"..", ".."});
  EXPECT_FALSE(legal(*map, 0.5, 0.5, 2.5, 0.5));
  EXPECT_FALSE(legal(*map, -0.5, 0.5, 1.5, 0.5));
  EXPECT_TRUE(legal(*map, 0.0, 0.0, 2.0, 0.0));  // along the border
}

TEST(Segment, APointIsASegment) {
  const auto map = costsOf({".#", "#."});
  EXPECT_TRUE(legal(*map, 0.5, 0.5, 0.5, 0.5));
  EXPECT_FALSE(legal(*map, 1.5, 0.5, 1.5, 0.5));
  EXPECT_TRUE(legal(*map, 1.0, 0.5, 1.0, 0.5));
  EXPECT_FALSE(legal(*map, 1.0, 1.0, 1.0, 1.0));
}

TEST(Segment, AlongAnEdgeTheCheaperPassableSideCounts) {
  const auto map = costsOf({"..??",  //
                            "??##"});
  const double cost =
      lineCost(*map, SegmentPoint::nearest({0.5, 1.0}), SegmentPoint::nearest({1.5, 1.0}));
  EXPECT_DOUBLE_EQ(cost, 1.0);
  EXPECT_DOUBLE_EQ(
      lineCost(*map, SegmentPoint::nearest({2.5, 1.0}), SegmentPoint::nearest({3.5, 1.0})), 50.0);
}

TEST(Segment, APieceCostsTheLargestWeightItMeets) {
  const auto map = costsOf({"...",  //
                            ".?."});
  // Half of the segment lies in row 0, the other half begins in the unknown cell.
  const double cost =
      lineCost(*map, SegmentPoint::centreOf({0, 0}), SegmentPoint::centreOf({2, 1}));
  EXPECT_DOUBLE_EQ(cost, std::sqrt(5.0) * 0.5 * (1.0 + 50.0));
}

TEST(SegmentLaw, CostOfAStepIsTheStepRule) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const CostGrid map = test::randomCosts(random, 12, {});
    for (std::uint32_t i = 0; i < map.geometry().size(); ++i) {
      const Cell from = map.geometry().cell(CellIndex(i));
      for (int row = -1; row <= 1; ++row)
        for (int column = -1; column <= 1; ++column) {
          const Cell to{from.column + column, from.row + row};
          if (!stepAllowed(map, from, to)) continue;
          ASSERT_TRUE(lineOfSight(map, SegmentPoint::centreOf(from), SegmentPoint::centreOf(to)));
          const double cost =
              lineCost(map, SegmentPoint::centreOf(from), SegmentPoint::centreOf(to));
          ASSERT_NEAR(cost, stepCost(map, from, to).toDouble(), 1e-9 * cost);
        }
    }
  }
}

// Points just beside a segment lie in the cells whose interior it meets.
std::set<std::pair<int, int>> cellsBySampling(Eigen::Vector2d from, Eigen::Vector2d to) {
  std::set<std::pair<int, int>> cells;
  constexpr int kSamples = 20000;
  for (int i = 0; i <= kSamples; ++i) {
    const Eigen::Vector2d point = from + (to - from) * (double(i) / kSamples);
    const double x = point.x() - std::round(point.x());
    const double y = point.y() - std::round(point.y());
    if (std::abs(x) < 1e-4 || std::abs(y) < 1e-4) continue;
    cells.emplace(int(std::floor(point.x())), int(std::floor(point.y())));
  }
  return cells;
}

// Whether every cell is passable that the segment meets or comes near.
bool isFarFromBlocked(const CostGrid& map, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  constexpr int kSamples = 500;
  constexpr double kNear = 0.02;  // cells; more than half of what lies between two samples
  for (int i = 0; i <= kSamples; ++i) {
    const Eigen::Vector2d point = from + (to - from) * (double(i) / kSamples);
    for (const double x : {point.x() - kNear, point.x() + kNear})
      for (const double y : {point.y() - kNear, point.y() + kNear})
        if (!map.passable({int(std::floor(x)), int(std::floor(y))})) return false;
  }
  return true;
}

// What touches a blocked cell may be either, but the same in both directions.
TEST(SegmentLaw, IsLegalOnlyWhereEverySampleIsPassableAndWhereAllAroundIs) {
  std::mt19937 random(5863);
  std::uniform_real_distribution<double> place(0.0, 8.0);
  int legal_ones = 0, far_ones = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    Grid<CostGrid::Weight> weights(GridGeometry(8, 8, 1.0), 1);
    for (auto& weight : weights.values()) weight = random() % 8 == 0 ? 0 : 1;
    const CostGrid map = test::costMap(weights);
    // Sixteenths of a cell meet many corners and edges, others none.
    const auto coordinate = [&] {
      const double drawn = place(random);
      return trial % 2 == 0 ? std::round(drawn * 2.0) / 2.0 : std::round(drawn * 16.0) / 16.0;
    };
    const Eigen::Vector2d from(coordinate(), coordinate());
    const Eigen::Vector2d to(coordinate(), coordinate());
    bool passable = true;
    for (const auto& cell : cellsBySampling(from, to))
      passable = passable && map.passable({cell.first, cell.second});
    const bool judged = legal(map, from.x(), from.y(), to.x(), to.y());
    EXPECT_EQ(judged, legal(map, to.x(), to.y(), from.x(), from.y()));
    if (judged) {
      ASSERT_TRUE(passable) << from.transpose() << " to " << to.transpose();
      ++legal_ones;
    }
    if (isFarFromBlocked(map, from, to)) {
      ASSERT_TRUE(judged) << from.transpose() << " to " << to.transpose();
      ++far_ones;
    }
  }
  EXPECT_GT(legal_ones, 200);
  EXPECT_GT(far_ones, 100);
}

}  // namespace
}  // namespace grid_path_planner::costmap
