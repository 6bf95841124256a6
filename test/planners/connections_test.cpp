#include "grid_path_planner/planners/connections.h"

#include <gtest/gtest.h>

#include <random>

#include "grid_path_planner/planners/decomposition.h"
#include "support/free_cells.h"

namespace grid_path_planner::planners {

using base::StopToken;
using grid::CellRect;

namespace {

using test::bitMapsOf;
using test::freeCells;

std::vector<Connection> listOf(const Connections& connections, std::uint32_t rectangle) {
  return {connections.of(rectangle).begin(), connections.of(rectangle).end()};
}

// How two disjoint rectangles touch, said anew: by the gap between them along each axis.
bool touch(const CellRect& a, const CellRect& b, Touching touching, Connection& connection) {
  const int columns =
      std::min(a.column + a.width, b.column + b.width) - std::max(a.column, b.column);
  const int rows = std::min(a.row + a.height, b.row + b.height) - std::max(a.row, b.row);
  if (columns == 0 && rows > 0)
    connection = {0, b.column > a.column ? Side::EAST : Side::WEST, std::max(a.row, b.row), rows};
  else if (rows == 0 && columns > 0)
    connection = {0, b.row > a.row ? Side::NORTH : Side::SOUTH, std::max(a.column, b.column),
                  columns};
  else if (rows == 0 && columns == 0 && touching == Touching::BORDERS_AND_CORNERS)
    connection = {0, Side::CORNER, 0, 0};
  else
    return false;
  return true;
}

TEST(Connections, OfARowOfRooms) {
  //  AAB
  //  AA#
  //  CDD
  const std::vector<CellRect> rectangles = {{0, 0, 2, 2}, {2, 0, 1, 1}, {0, 2, 1, 1}, {1, 2, 2, 1}};
  const Connections connections(rectangles, Touching::BORDERS);
  EXPECT_EQ(listOf(connections, 0),
            (std::vector<Connection>{
                {1, Side::EAST, 0, 1}, {2, Side::NORTH, 0, 1}, {3, Side::NORTH, 1, 1}}));
  EXPECT_EQ(listOf(connections, 1), (std::vector<Connection>{{0, Side::WEST, 0, 1}}));
  EXPECT_EQ(listOf(connections, 2),
            (std::vector<Connection>{{0, Side::SOUTH, 0, 1}, {3, Side::EAST, 2, 1}}));
  EXPECT_EQ(listOf(connections, 3),
            (std::vector<Connection>{{0, Side::SOUTH, 1, 1}, {2, Side::WEST, 2, 1}}));
  EXPECT_EQ(connections.size(), 8U);
}

TEST(Connections, CornersOnlyWhereAsked) {
  const std::vector<CellRect> rectangles = {{0, 0, 1, 1}, {1, 1, 1, 1}, {0, 2, 1, 3}};
  EXPECT_EQ(Connections(rectangles, Touching::BORDERS).size(), 0U);
  const Connections connections(rectangles, Touching::BORDERS_AND_CORNERS);
  EXPECT_EQ(listOf(connections, 1),
            (std::vector<Connection>{{0, Side::CORNER, 0, 0}, {2, Side::CORNER, 0, 0}}));
}

TEST(Connections, OfNoRectangles) {
  EXPECT_EQ(Connections({}, Touching::BORDERS).size(), 0U);
}

TEST(Connections, AreThoseThatEveryPairSays) {
  std::mt19937 random(20261121);
  for (int trial = 0; trial < 120; ++trial) {
    const auto free =
        trial % 2 == 0 ? test::randomFreeCells(random, 20, 0.7) : test::randomBlocks(random, 60);
    const auto rectangles = largestFirst(bitMapsOf(free), {}, StopToken());
    for (const Touching touching : {Touching::BORDERS, Touching::BORDERS_AND_CORNERS}) {
      const Connections connections(rectangles, touching);
      for (std::uint32_t i = 0; i < rectangles.size(); ++i) {
        std::vector<Connection> expected;
        for (std::uint32_t j = 0; j < rectangles.size(); ++j) {
          Connection connection{};
          if (i == j || !touch(rectangles[i], rectangles[j], touching, connection)) continue;
          connection.to = j;
          expected.push_back(connection);
        }
        ASSERT_EQ(listOf(connections, i), expected);
      }
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
