#include "grid/grid_alignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::grid {
namespace {

TEST(GridAlignment, MapsWhoseCellsAreTheSamePlacesStayAsTheyAre) {
  // 0.05 m is none of the numbers of a double, nor are these origins.
  const GridGeometry from(40, 30, 0.05, {-1.35, 7.15, 0.0}), to(400, 300, 0.05, {-9.15, 2.05, 0.0});
  const GridAlignment alignment(from, to);
  EXPECT_EQ(alignment.touched({3, 5, 1, 2}), (CellRect{159, 107, 1, 2}));
  EXPECT_EQ(alignment.sources({159, 107}), (CellRect{3, 5, 1, 1}));
  EXPECT_TRUE(alignment.covers({156, 102}));
  EXPECT_FALSE(alignment.covers({155, 102}));
}

TEST(GridAlignment, ACoarseCellLiesOnAllFineOnesThatItTouches) {
  const GridAlignment alignment(GridGeometry(2, 1, 1.0, {0.25, 0.0, 0.0}), GridGeometry(6, 2, 0.5));
  EXPECT_EQ(alignment.touched({0, 0, 1, 1}), (CellRect{0, 0, 3, 2}));
  EXPECT_EQ(alignment.sources({2, 0}), (CellRect{0, 0, 2, 1}));
  EXPECT_FALSE(alignment.covers({0, 0})) << "its left half is not known";
}

TEST(GridAlignment, WhatDoesNotMeetTouchesNothing) {
  const GridAlignment alignment(GridGeometry(2, 2, 1.0, {100.0, 0.0, 0.0}),
                                GridGeometry(4, 4, 1.0));
  EXPECT_TRUE(alignment.touched({0, 0, 2, 2}).empty());
  EXPECT_TRUE(alignment.sources({3, 3}).empty());
}

TEST(GridAlignment, AYawIsRefused) {
  EXPECT_THROW(GridAlignment(GridGeometry(2, 2, 1.0, {0, 0, 0.1}), GridGeometry(2, 2, 1.0)),
               base::InputError);
}

// Both directions say the same, and it is what the rectangles of the cells in metres say.
TEST(GridAlignment, CellsLieOnOneAnotherWhereTheyOverlap) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-3.0, 3.0), size(0.2, 1.5);
  for (int round = 0; round < 300; ++round) {
    const GridGeometry a(7, 5, size(random), {place(random), place(random), 0.0});
    const GridGeometry b(6, 8, size(random), {place(random), place(random), 0.0});
    const GridAlignment forwards(a, b);
    for (int i = 0; i < 35; ++i)
      for (int j = 0; j < 48; ++j) {
        const Cell of_a{i % 7, i / 7}, of_b{j % 6, j / 6};
        const Eigen::Vector2d a_low = a.worldFromGrid({of_a.column, of_a.row});
        const Eigen::Vector2d b_low = b.worldFromGrid({of_b.column, of_b.row});
        const Eigen::Vector2d low = a_low.cwiseMax(b_low);
        const Eigen::Vector2d high =
            (a_low.array() + a.resolution()).min(b_low.array() + b.resolution());
        const bool overlap = (high - low).minCoeff() > 0.0;
        ASSERT_EQ(forwards.sources(of_b).contains(of_a), overlap);
        ASSERT_EQ(forwards.touched({of_a.column, of_a.row, 1, 1}).contains(of_b), overlap);
      }
  }
}

}  // namespace
}  // namespace grid_path_planner::grid
