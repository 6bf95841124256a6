#include "planners/rectangles/funnel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "grid_path_planner/planners/decomposition.h"
#include "support/free_cells.h"
#include "support/random_map.h"

namespace grid_path_planner::planners {

using base::StopToken;
using costmap::SegmentPoint;
using grid::Cell;
using grid::CellRect;
using grid::GridGeometry;

namespace {

constexpr std::int64_t kHalf = SegmentPoint::kUnitsPerCell / 2;

SegmentPoint corner(int column, int row) {
  return {column * 2 * kHalf, row * 2 * kHalf};
}

std::vector<SegmentPoint> taut(const std::vector<CellRect>& rectangles, Cell start, Cell goal) {
  std::int32_t side = 1;
  for (const CellRect& rect : rectangles)
    side = std::max({side, rect.column + rect.width, rect.row + rect.height});
  const RectangleGraph map(GridGeometry(side, side, 1.0), rectangles, Touching::BORDERS);
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
  // The reverse path has the same points.
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

// ---- against every choice of turning points

double distance(SegmentPoint a, SegmentPoint b) {
  return std::hypot(double(a.x - b.x), double(a.y - b.y)) / SegmentPoint::kUnitsPerCell;
}

// A border as its two ends.
std::pair<SegmentPoint, SegmentPoint> endsOf(const CellRect& from, const Connection& step) {
  switch (step.side) {
    case Side::EAST:
      return {corner(from.column + from.width, step.first),
              corner(from.column + from.width, step.first + step.length)};
    case Side::WEST:
      return {corner(from.column, step.first), corner(from.column, step.first + step.length)};
    case Side::NORTH:
      return {corner(step.first, from.row + from.height),
              corner(step.first + step.length, from.row + from.height)};
    default:
      return {corner(step.first, from.row), corner(step.first + step.length, from.row)};
  }
}

bool crosses(SegmentPoint a, SegmentPoint b, const std::pair<SegmentPoint, SegmentPoint>& border) {
  const auto turn = [](SegmentPoint p, SegmentPoint q, SegmentPoint r) {
    const std::int64_t area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
  };
  const int first = turn(a, b, border.first), second = turn(a, b, border.second);
  if (first == 0 && second == 0) return true;  // along it
  return first * second <= 0 &&
         turn(border.first, border.second, a) * turn(border.first, border.second, b) <= 0;
}

// The least length over all paths that turn at ends of borders only, borders crossed in order.
double leastLength(const RectangleGraph& map, const RectangleRoute& route, SegmentPoint start,
                   SegmentPoint goal) {
  std::vector<std::pair<SegmentPoint, SegmentPoint>> borders = {{start, start}};
  std::uint32_t rectangle = route.first;
  for (const Connection& step : route.steps) {
    borders.push_back(endsOf(map.rectangles()[rectangle], step));
    rectangle = step.to;
  }
  borders.push_back({goal, goal});
  const double infinite = std::numeric_limits<double>::infinity();
  std::vector<std::array<double, 2>> least(borders.size(), {infinite, infinite});
  least[0] = {0.0, 0.0};
  const auto end = [&borders](std::size_t i, int side) {
    return side == 0 ? borders[i].first : borders[i].second;
  };
  for (std::size_t to = 1; to < borders.size(); ++to)
    for (std::size_t from = 0; from < to; ++from)
      for (int a : {0, 1})
        for (int b : {0, 1}) {
          bool open = true;
          for (std::size_t i = from + 1; open && i < to; ++i)
            open = crosses(end(from, a), end(to, b), borders[i]);
          if (open)
            least[to][std::size_t(b)] =
                std::min(least[to][std::size_t(b)],
                         least[from][std::size_t(a)] + distance(end(from, a), end(to, b)));
        }
  return least.back()[0];
}

TEST(FunnelLaw, NoOtherTurningPointsAreShorter) {
  std::mt19937 random(20261121);
  int bent = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const auto free =
        trial % 2 == 0 ? test::randomFreeCells(random, 16, 0.75) : test::randomBlocks(random, 40);
    const RectangleGraph map(free.geometry(), largestFirst(test::bitMapsOf(free), {}, StopToken()),
                             Touching::BORDERS);
    const Cell start = test::randomCell(random, free.geometry());
    const Cell goal = test::randomCell(random, free.geometry());
    if (free[start] == 0 || free[goal] == 0) continue;
    RectangleSearch search;
    for (const auto& weight : choicesOf(RectangleWeight{})) {
      const RectangleRoute route = search.find(map, weight.second, start, goal, StopToken());
      if (!route.found) continue;
      const SegmentPoint a = SegmentPoint::centreOf(start), b = SegmentPoint::centreOf(goal);
      const std::vector<SegmentPoint> points = shortestThrough(map, route, a, b);
      double length = 0.0;
      for (std::size_t i = 1; i < points.size(); ++i) length += distance(points[i - 1], points[i]);
      bent += points.size() > 2 ? 1 : 0;
      ASSERT_NEAR(length, leastLength(map, route, a, b), 1e-9) << "trial " << trial;
    }
  }
  EXPECT_GT(bent, 200);
}

}  // namespace
}  // namespace grid_path_planner::planners
