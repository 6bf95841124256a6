#include "grid_path_planner/grid/grid_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::grid {

using base::InputError;

namespace {

TEST(GridGeometry, OriginIsTheCornerOfTheFirstCell) {
  const GridGeometry geometry(4, 3, 0.5, {-1.0, 2.0, 0.0});
  EXPECT_DOUBLE_EQ(geometry.centre({0, 0}).x(), -0.75);
  EXPECT_DOUBLE_EQ(geometry.centre({0, 0}).y(), 2.25);
  EXPECT_EQ(geometry.cellAt({-1.0, 2.0}), (Cell{0, 0}));
}

TEST(GridGeometry, YawTurnsTheMapAnticlockwise) {
  const GridGeometry geometry(4, 3, 1.0, {10.0, 0.0, M_PI / 2});
  EXPECT_NEAR(geometry.centre({2, 0}).x(), 9.5, 1e-12);
  EXPECT_NEAR(geometry.centre({2, 0}).y(), 2.5, 1e-12);
}

TEST(GridGeometry, FirstAndLastColumnAreNeverTheSamePlace) {
  const GridGeometry geometry(5, 4, 1.0);
  EXPECT_FALSE(geometry.cellAt({5.0, 1.5}).has_value());
  EXPECT_FALSE(geometry.cellAt({-0.5, 1.5}).has_value());
  EXPECT_FALSE(geometry.cellAt({1.5, 4.0}).has_value());
}

TEST(GridGeometry, NoCellForPointsThatAreNotFinite) {
  const GridGeometry geometry(5, 4, 1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(geometry.cellAt({nan, 1.0}).has_value());
  EXPECT_FALSE(geometry.cellAt({1.0, infinity}).has_value());
  EXPECT_FALSE(geometry.cellAt({1e300, -1e300}).has_value());
}

TEST(GridGeometry, BadGeometryIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(GridGeometry(0, 0, 1.0), InputError);
  EXPECT_THROW(GridGeometry(-3, 4, 1.0), InputError);
  EXPECT_THROW(GridGeometry(1 << 19, 1 << 19, 1.0), InputError);
  for (const double resolution : {0.0, -0.05, nan, infinity})
    EXPECT_THROW(GridGeometry(3, 4, resolution), InputError) << resolution;
  for (const double resolution : {1e-38, 1e-7, 1e7, 1e38})
    EXPECT_THROW(GridGeometry(3, 4, resolution), InputError) << resolution;
  EXPECT_THROW(GridGeometry(3, 4, 1.0, {1e308, 0.0, 0.0}), InputError);
  EXPECT_THROW(GridGeometry(3, 4, 1.0, {0.0, -1e9, 0.0}), InputError);
  EXPECT_THROW(GridGeometry(3, 4, 1.0, {nan, 0.0, 0.0}), InputError);
  EXPECT_THROW(GridGeometry(3, 4, 1.0, {0.0, 0.0, infinity}), InputError);
}

// navigation PR#1219: half-cell errors end in collision.
TEST(GridGeometryLaw, CellToWorldToCellIsTheIdentity) {
  std::mt19937 random(1219);
  for (int trial = 0; trial < 200; ++trial) {
    std::uniform_int_distribution<int> side(1, 60);
    std::uniform_real_distribution<double> place(-1000.0, 1000.0);
    std::uniform_real_distribution<double> angle(-M_PI, M_PI);
    const double resolution = std::exp(std::uniform_real_distribution<double>(-4.0, 2.0)(random));
    const GridGeometry geometry(side(random), side(random), resolution,
                                {place(random), place(random), angle(random)});
    for (std::uint32_t i = 0; i < geometry.size(); ++i) {
      const Cell cell = geometry.cell(CellIndex(i));
      EXPECT_EQ(geometry.index(cell), CellIndex(i));
      ASSERT_EQ(geometry.cellAt(geometry.centre(cell)), cell) << "trial " << trial;
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::grid
