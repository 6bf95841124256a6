#include "layers/scan_layer.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "layers/ray_cells.h"

namespace grid_path_planner::layers {
namespace {

using Eigen::Vector2d;
using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;

class LaserPicture : public testing::Test {
 protected:
  LaserPicture() { layer_.reset(map_); }

  // From the middle of the lower left cell.
  void see(double time, std::vector<Beam> beams) {
    for (Beam& beam : beams) beam.range = (beam.end - kOrigin).norm();
    layer_.insert({time, kOrigin, std::move(beams)}, options_, map_, changed_);
  }
  // The upper row first, as one looks at it; ' ' unknown, '.' free, '#' occupied.
  std::string row(int number) const {
    std::string text;
    for (int column = 0; column < map_.width(); ++column) {
      const int value = map_.row(number)[column];
      text += value < 0 ? ' ' : value == 0 ? '.' : '#';
    }
    return text;
  }

  const Vector2d kOrigin{0.5, 0.5};
  ScanLayerOptions options_{100.0, 100.0, 0.0, false};
  OccupancyGrid map_{GridGeometry(6, 3, 1.0), 0};
  ScanLayer layer_;
  ChangedCells changed_;
};

TEST_F(LaserPicture, RaysClearAndHitsMark) {
  see(1.0, {{{4.5, 0.5}, 0, true}});
  EXPECT_EQ(row(0), "....# ");
  EXPECT_EQ(row(1), "      ");
  see(2.0, {{{5.5, 0.5}, 0, true}});
  EXPECT_EQ(row(0), ".....#") << "it went away";
}

TEST_F(LaserPicture, NoRayClearsWhatAnotherOfTheScanHits) {
  see(1.0, {{{3.5, 0.5}, 0, true}, {{5.5, 0.6}, 0, true}});
  EXPECT_EQ(row(0), "...#.#");
}

TEST_F(LaserPicture, FarHitsMarkNothingAndFarRaysClearNothing) {
  options_.obstacle_max_range = 3.0;
  options_.clearing_max_range = 2.0;
  see(1.0, {{{5.5, 0.5}, 0, true}});
  EXPECT_EQ(row(0), "..    ");
  see(2.0, {{{3.4, 0.5}, 0, true}});
  EXPECT_EQ(row(0), ".. #  ");
}

TEST_F(LaserPicture, ARayWithoutAHitClearsAndMarksNothing) {
  see(1.0, {{{5.5, 0.5}, 0, false}});
  EXPECT_EQ(row(0), "..... ");
}

TEST_F(LaserPicture, WhatLiesOutsideIsPassedOver) {
  see(1.0, {{{50.5, 0.5}, 0, true}, {{-7.5, 0.5}, 0, true}, {{0.5, 99.0}, 0, true}});
  EXPECT_EQ(row(0), "......");
  EXPECT_EQ(row(2), ".     ");
}

TEST_F(LaserPicture, MarksThatAreNotHitAgainAreForgotten) {
  see(1.0, {{{4.5, 0.5}, 0, true}, {{2.5, 2.4}, 0, true}});
  see(5.0, {{{4.5, 0.5}, 0, true}});
  layer_.expire(7.0, 0.0, map_, changed_);
  EXPECT_EQ(row(2), "  #   ") << "0: for ever";
  changed_.clear();
  layer_.expire(7.0, 3.0, map_, changed_);
  EXPECT_EQ(row(0), "....# ");
  EXPECT_EQ(row(2), "      ");
  EXPECT_EQ(changed_.take(), (std::vector<grid::CellRect>{{2, 2, 1, 1}}));
  layer_.expire(9.0, 3.0, map_, changed_);
  EXPECT_EQ(row(0), "....  ");
}

// NTP set the clock forward, or a /clock of far ahead came: all that the laser had marked was forgotten at once.
TEST_F(LaserPicture, AClockThatLeapsAheadForgetsNothing) {
  see(1.0, {{{4.5, 0.5}, 0, true}});
  layer_.expire(2.0, 60.0, map_, changed_);
  see(1e6, {{{2.5, 2.4}, 0, true}});  // by the new clock, before it is asked what expires
  layer_.expire(1e6, 60.0, map_, changed_);
  EXPECT_EQ(row(0), "....# ") << "it is 11 s old";
  EXPECT_EQ(row(2), "  #   ");
  for (double passed = 10.0; passed <= 40.0; passed += 10.0)
    layer_.expire(1e6 + passed, 60.0, map_, changed_);
  EXPECT_EQ(row(0), "....# ");
  layer_.expire(1e6 + 50.0, 60.0, map_, changed_);
  EXPECT_EQ(row(0), "....  ") << "61 s, and nobody has seen it again";
  EXPECT_EQ(row(2), "  #   ");
  layer_.expire(1e6 + 59.0, 60.0, map_, changed_);
  EXPECT_EQ(row(2), "  #   ");
  layer_.expire(1e6 + 61.0, 60.0, map_, changed_);
  EXPECT_EQ(row(2), "      ");
}

// By another hand: every cell of the map is asked whether the segment meets its interior.
TEST(RayCells, AreThoseThatTheSegmentMeets) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-4.0, 12.0);
  const grid::CellRect map{0, 0, 8, 8};
  for (int round = 0; round < 3000; ++round) {
    const Vector2d from(place(random), place(random)), to(place(random), place(random));
    std::set<std::pair<int, int>> visited, met;
    visitRayCells(from, to, map, [&](Cell cell) {
      ASSERT_TRUE(map.contains(cell));
      ASSERT_TRUE(visited.insert({cell.column, cell.row}).second) << "twice";
    });
    for (int row = 0; row < 8; ++row)
      for (int column = 0; column < 8; ++column) {
        const SegmentPart part = partIn(from, to, {column, row, 1, 1});
        const bool end =
            to.x() >= column && to.x() < column + 1 && to.y() >= row && to.y() < row + 1;
        if (part.end - part.begin > 1e-12 && !end) met.insert({column, row});
      }
    ASSERT_EQ(visited, met) << "round " << round;
  }
}

TEST(RayCells, AlongALineOfTheGridGoByOneSide) {
  int visited = 0;
  visitRayCells({0.5, 2.0}, {4.5, 2.0}, {0, 0, 8, 8}, [&](Cell cell) {
    EXPECT_EQ(cell.row, 2);
    ++visited;
  });
  EXPECT_EQ(visited, 4);
}

}  // namespace
}  // namespace grid_path_planner::layers
