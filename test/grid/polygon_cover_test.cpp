#include "grid/polygon_cover.h"

#include <gtest/gtest.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>
#include <random>
#include <string>

namespace grid_path_planner::grid {
namespace {

namespace bg = boost::geometry;
using Eigen::Vector2d;
using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point>;
using Box = bg::model::box<Point>;

// The first line is row 0; '#' is touched.
std::vector<std::string> picture(const std::vector<Vector2d>& corners, int width, int height) {
  std::vector<std::string> lines(static_cast<std::size_t>(height),
                                 std::string(static_cast<std::size_t>(width), '.'));
  for (const RowSpan& span : touchedCells(corners, {0, 0, width, height}))
    for (int column = span.first; column < span.end; ++column)
      lines[static_cast<std::size_t>(span.row)][static_cast<std::size_t>(column)] = '#';
  return lines;
}

using Lines = std::vector<std::string>;

TEST(PolygonCover, ASquareOnTheGridTouchesItsOwnCellsAndNoOther) {
  EXPECT_EQ(picture({{1, 1}, {3, 1}, {3, 2}, {1, 2}}, 4, 3), (Lines{"....",  //
                                                                    ".##.",  //
                                                                    "...."}));
}

TEST(PolygonCover, WhatLeavesACellByAHairTouchesTheNext) {
  EXPECT_EQ(picture({{1, 1}, {3.001, 1}, {3.001, 2}, {1, 2}}, 4, 3), (Lines{"....",  //
                                                                            ".###",  //
                                                                            "...."}));
}

TEST(PolygonCover, AThinWedgeTouchesWhatItCrossesThoughItHoldsNoCentre) {
  EXPECT_EQ(picture({{0.1, 0.1}, {3.9, 2.8}, {3.9, 2.9}}, 4, 3), (Lines{"##..",  //
                                                                        ".##.",  //
                                                                        "..##"}));
}

TEST(PolygonCover, AHoleOfAPolygonThatRunsAroundItIsOutside) {
  EXPECT_EQ(
      picture({{0, 0}, {5, 0}, {5, 5}, {0, 5}, {0, 1}, {1, 1}, {1, 4}, {4, 4}, {4, 1}, {0, 1}}, 5,
              5),
      (Lines{"#####",  //
             "#...#",  //
             "#...#",  //
             "#...#",  //
             "#####"}));
}

TEST(PolygonCover, WhatLiesOutsideIsPassedOverAndWhatIsLargerFillsAll) {
  EXPECT_EQ(picture({{-9, -9}, {-1, -9}, {-1, -1}}, 2, 2), (Lines{"..", ".."}));
  EXPECT_EQ(picture({{-1e9, -1e9}, {1e9, -1e9}, {1e9, 1e9}, {-1e9, 1e9}}, 2, 2),
            (Lines{"##", "##"}));
  EXPECT_TRUE(touchedCells({{0, 0}, {1, 0}, {0, 1}}, {}).empty());
}

// A star around its middle, so that it does not cross itself.
std::vector<Vector2d> randomPolygon(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const int corners = std::uniform_int_distribution<int>(3, 12)(random);
  const bool on_the_grid = share(random) < 0.3;
  const Vector2d middle(size * share(random), size * share(random));
  std::vector<Vector2d> polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.8 * share(random)) / corners;
    const double radius = size * (0.05 + 0.6 * share(random));
    Vector2d corner = middle + radius * Vector2d(std::cos(angle), std::sin(angle));
    if (on_the_grid) corner = corner.array().round();
    polygon.push_back(corner);
  }
  return polygon;
}

// By another hand: Boost.Geometry's area of what a cell and the polygon share.
TEST(PolygonCover, TouchedAreTheCellsThatShareAnAreaWithThePolygon) {
  std::mt19937 random(17);
  int compared = 0;
  for (int round = 0; round < 400; ++round) {
    const std::vector<Vector2d> corners = randomPolygon(random, 12.0);
    Polygon polygon;
    for (const Vector2d& corner : corners) bg::append(polygon, Point(corner.x(), corner.y()));
    bg::correct(polygon);
    if (!bg::is_valid(polygon)) continue;  // rounded corners may fall on one another
    const Lines touched = picture(corners, 12, 12);
    for (int row = 0; row < 12; ++row)
      for (int column = 0; column < 12; ++column) {
        std::vector<Polygon> shared;
        bg::intersection(Box(Point(column, row), Point(column + 1, row + 1)), polygon, shared);
        double area = 0.0;
        for (const Polygon& part : shared) area += bg::area(part);
        const bool is_touched =
            touched[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] == '#';
        ASSERT_EQ(is_touched, area > 1e-12)
            << "round " << round << ", cell " << column << ", " << row;
        ++compared;
      }
  }
  EXPECT_GT(compared, 40000);
}

}  // namespace
}  // namespace grid_path_planner::grid
