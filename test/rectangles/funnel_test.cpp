#include "grid_path_planner/rectangles/funnel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace grid_path_planner {
namespace {

constexpr std::int64_t kHalf = SegmentPoint::kUnitsPerCell / 2;

SegmentPoint corner(int column, int row) {
  return {column * 2 * kHalf, row * 2 * kHalf};
}

std::vector<SegmentPoint> taut(const std::vector<CellRect>& rectangles, Cell start, Cell goal) {
  std::int32_t side = 1;
  for (const CellRect& rect : rectangles)
    side = std::max({side, rect.column + rect.width, rect.row + rect.height});
  const RectangleMap map(GridGeometry(side, side, 1.0), rectangles, Touching::BORDERS);
  RectangleSearch search;
  const RectangleRoute route = search.find(map, RectangleWeight::LENGTH, start, goal, StopToken());
  EXPECT_TRUE(route.found);
  return shortestThrough(map, route, SegmentPoint::centreOf(start), SegmentPoint::centreOf(goal));
}

TEST(Funnel, IsStraightWhereItCanBe) {
  EXPECT_EQ(
      taut({{0, 0, 3, 3}, {3, 0, 3, 3}}, {0, 0}, {5, 2}),
      (std::vector<SegmentPoint>{SegmentPoint::centreOf({0, 0}), SegmentPoint::centreOf({5, 2})}));
  EXPECT_EQ(taut({{0, 0, 3, 3}}, {1, 1}, {1, 1}),
            (std::vector<SegmentPoint>{SegmentPoint::centreOf({1, 1})}));
}

TEST(Funnel, TurnsAtTheCornersOfNarrowDoors) {
  // Rooms to the left and right of a wall, joined by the one cell (3, 4).
  EXPECT_EQ(taut({{0, 0, 3, 5}, {3, 4, 1, 1}, {4, 0, 3, 5}}, {0, 0}, {6, 0}),
            (std::vector<SegmentPoint>{SegmentPoint::centreOf({0, 0}), corner(3, 4), corner(4, 4),
                                       SegmentPoint::centreOf({6, 0})}));
  // The way back is the same one.
  EXPECT_EQ(taut({{0, 0, 3, 5}, {3, 4, 1, 1}, {4, 0, 3, 5}}, {6, 0}, {0, 0}),
            (std::vector<SegmentPoint>{SegmentPoint::centreOf({6, 0}), corner(4, 4), corner(3, 4),
                                       SegmentPoint::centreOf({0, 0})}));
}

TEST(Funnel, WindsThroughAStaircase) {
  // Each step one cell: turns left and right by turns.
  const auto points =
      taut({{0, 0, 2, 1}, {1, 1, 2, 1}, {2, 2, 2, 1}, {3, 3, 2, 1}}, {0, 0}, {4, 3});
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length +=
        std::hypot(double(points[i].x - points[i - 1].x), double(points[i].y - points[i - 1].y)) /
        SegmentPoint::kUnitsPerCell;
  EXPECT_LT(length, 5.2);
  EXPECT_GE(length, 5.0);
}

}  // namespace
}  // namespace grid_path_planner
