// Where distances are kept, straight lines lie in the centre lattice.
#include <gtest/gtest.h>

#include <random>

#include "grid_path_planner/costmap/line_of_sight.h"
#include "support/cost_maps.h"
#include "support/random_map.h"
#include "support/visibility_graph.h"

namespace grid_path_planner::costmap {

using grid::Cell;

namespace {

CostGrid keeping(CostGrid map) {
  map.setKeptDistances({0.5, -1.0, 0.0});
  return map;
}

bool legalBetween(const CostGrid& map, double x0, double y0, double x1, double y1) {
  return lineOfSight(map, SegmentPoint::nearest({x0, y0}), SegmentPoint::nearest({x1, y1}));
}

TEST(CentreLattice, EndsAtTheOutermostCentres) {
  const CostGrid map = keeping(test::costMap({"...", "..."}));
  EXPECT_TRUE(legalBetween(map, 0.5, 0.5, 2.5, 1.5));
  EXPECT_TRUE(legalBetween(map, 0.75, 1.25, 2.25, 0.5));
  EXPECT_FALSE(legalBetween(map, 0.25, 1.0, 2.5, 1.0));
  EXPECT_FALSE(legalBetween(map, 0.5, 1.5, 2.5, 1.75));
}

// Grazing the corner of a blocked cell, or running along its edge, is half a cell too near.
TEST(CentreLattice, KeepsHalfACellFromBlockedOnes) {
  const CostGrid map = keeping(test::costMap({".....", "..#..", "....."}));
  EXPECT_FALSE(legalBetween(map, 0.5, 1.0, 4.5, 1.0));
  EXPECT_FALSE(legalBetween(map, 0.5, 1.5, 2.5, 0.5));
  EXPECT_TRUE(legalBetween(map, 0.5, 0.5, 4.5, 0.5));
  EXPECT_TRUE(legalBetween(map, 1.5, 0.5, 1.5, 2.5));
}

// A passage of one cell: only along the line of its centres.
TEST(CentreLattice, LeadsThroughAPassageOfOneCell) {
  const CostGrid map = keeping(test::costMap({"..###..", ".......", "..###.."}));
  EXPECT_TRUE(legalBetween(map, 0.5, 1.5, 6.5, 1.5));
  EXPECT_TRUE(legalBetween(map, 1.75, 1.5, 3.0, 1.5));
  EXPECT_FALSE(legalBetween(map, 0.5, 1.5, 6.5, 1.25));
  EXPECT_FALSE(legalBetween(map, 0.5, 0.5, 6.5, 2.5));
}

// Squares that meet at a centre: the line passes through that centre only.
TEST(CentreLattice, LeadsThroughTheCentreBetweenTwoSquares) {
  const CostGrid map = keeping(test::costMap({"..#", "...", "#.."}));
  EXPECT_TRUE(legalBetween(map, 0.5, 0.5, 2.5, 2.5));
  EXPECT_FALSE(legalBetween(map, 0.5, 0.5, 2.5, 2.25));
}

TEST(CentreLattice, HoldsTheCentreOfALonelyCell) {
  const CostGrid map = keeping(test::costMap({"###", "#.#", "###"}));
  EXPECT_TRUE(legalBetween(map, 1.5, 1.5, 1.5, 1.5));
  EXPECT_FALSE(legalBetween(map, 1.5, 1.5, 1.75, 1.5));
  EXPECT_FALSE(legalBetween(map, 1.25, 1.5, 1.25, 1.5));
}

TEST(CentreLattice, DoesNotMatterWhereCornersMayBeCut) {
  CostGrid map = test::costMap(test::costMap({"..", ".#"}).weights(),
                               {Connectivity::EIGHT, DiagonalCost::SQRT2, true});
  EXPECT_TRUE(legalBetween(keeping(map), 0.5, 1.5, 1.5, 0.5));
}

TEST(CentreLatticeLaw, EveryPieceOfALegalLineLiesInASquareOrOnAnEdge) {
  std::mt19937 random(25);
  int legal_ones = 0, illegal_ones = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const CostGrid map = keeping(test::randomCosts(random, 12, {}));
    const Cell from = test::randomCell(random, map.geometry());
    const Cell to = test::randomCell(random, map.geometry());
    const double shift = trial % 3 == 0 ? 0.25 : 0.0;
    const Eigen::Vector2d a(from.column + 0.5, from.row + 0.5 + shift);
    const Eigen::Vector2d b(to.column + 0.5, to.row + 0.5 - shift);
    const bool expected = test::inLattice(map, a, b);
    ASSERT_EQ(legalBetween(map, a.x(), a.y(), b.x(), b.y()), expected)
        << "trial " << trial << " from " << from << " to " << to;
    ++(expected ? legal_ones : illegal_ones);
  }
  EXPECT_GT(legal_ones, 300);
  EXPECT_GT(illegal_ones, 300);
}

// In the last blocks of a kernel the centres lie nearer together.
TEST(CentreLattice, HasTheWaypointsOfBlocks) {
  CostGrid map(test::Weights(grid::GridGeometry(3, 2, 2.0), 1),
               grid::Grid<grid::Occupancy>(grid::GridGeometry(3, 2, 2.0)), {}, 2,
               grid::GridGeometry(5, 4, 1.0));
  map = keeping(map);
  EXPECT_EQ(waypointOf(map, {2, 0}), SegmentPoint::nearest({2.25, 0.5}));
  EXPECT_TRUE(legalBetween(map, 0.5, 0.5, 2.25, 1.5));
  EXPECT_FALSE(legalBetween(map, 0.5, 0.5, 2.5, 1.5));
  EXPECT_TRUE(legalBetween(map, 2.25, 0.5, 2.25, 1.5));
}

}  // namespace
}  // namespace grid_path_planner::costmap
