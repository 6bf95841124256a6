// Rectangle maps that are edited: partitions like those made anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <tuple>

#include "grid_path_planner/planners/decomposition.h"
#include "grid_path_planner/planners/rectangle_graph.h"
#include "support/free_cells.h"

namespace grid_path_planner::planners {

using base::Stopped;
using base::StopSource;
using base::StopToken;
using costmap::BitMaps;
using grid::Cell;
using grid::CellIndex;
using grid::CellRect;
using grid::GridGeometry;

namespace {

using test::bitMapsOf;
using test::FreeCells;
using test::freeCells;

RectangleGraph mapOf(const FreeCells& free, Touching touching = Touching::BORDERS) {
  return RectangleGraph(free.geometry(), largestFirst(bitMapsOf(free), {}, StopToken()), touching);
}

RectangleEdit edit(RectangleGraph& map, const FreeCells& free, const CellRect& changed) {
  return map.edit(bitMapsOf(free).rows, changed, StopToken());
}

std::vector<CellRect> sorted(std::vector<CellRect> rectangles) {
  std::sort(rectangles.begin(), rectangles.end(), [](const CellRect& a, const CellRect& b) {
    return std::tie(a.row, a.column) < std::tie(b.row, b.column);
  });
  return rectangles;
}

std::vector<CellRect> present(const RectangleGraph& map) {
  std::vector<CellRect> rectangles;
  for (const CellRect& rect : map.rectangles())
    if (!rect.empty()) rectangles.push_back(rect);
  return rectangles;
}

TEST(RectangleEdit, ACellThatIsBlockedCutsItsRectangle) {
  FreeCells free = freeCells({"11111",  //
                              "11111",  //
                              "11111"});
  RectangleGraph map = mapOf(free);
  free[Cell{3, 1}] = 0;
  const RectangleEdit edited = edit(map, free, {3, 1, 1, 1});
  EXPECT_EQ(sorted(present(map)),
            (std::vector<CellRect>{{0, 0, 3, 3}, {3, 0, 1, 1}, {4, 0, 1, 3}, {3, 2, 1, 1}}));
  EXPECT_EQ(edited.removed, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(edited.added, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(RectangleEdit, ACellThatIsFreedJoinsItsNeighbours) {
  FreeCells free = freeCells({"11111",  //
                              "111#1",  //
                              "11111"});
  RectangleGraph map = mapOf(free);
  free[Cell{3, 1}] = 1;
  edit(map, free, {3, 1, 1, 1});
  EXPECT_EQ(present(map), (std::vector<CellRect>{{0, 0, 5, 3}}));
  EXPECT_EQ(map.count(), 1U);
  EXPECT_EQ(map.connections().count(), 0U);
}

TEST(RectangleEdit, TheOthersKeepTheirNumbers) {
  FreeCells free = freeCells({"1111#11",  //
                              "1111#11",  //
                              "1111#11"});
  RectangleGraph map = mapOf(free);
  ASSERT_EQ(map.rectangles(), (std::vector<CellRect>{{0, 0, 4, 3}, {5, 0, 2, 3}}));
  free[Cell{0, 0}] = 0;
  const RectangleEdit edited = edit(map, free, free.geometry().rect());
  EXPECT_EQ(map.rectangles()[1], (CellRect{5, 0, 2, 3}));
  EXPECT_EQ(edited.removed, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(edited.added, (std::vector<std::uint32_t>{0, 2}));
}

TEST(RectangleEdit, NothingChangesWhereNothingChanged) {
  std::mt19937 random(13);
  for (int trial = 0; trial < 50; ++trial) {
    const FreeCells free = test::randomFreeCells(random, 100, 0.7);
    RectangleGraph map = mapOf(free);
    const std::vector<CellRect> before = map.rectangles();
    const CellRect changed{static_cast<int>(random() % 100), static_cast<int>(random() % 100), 9,
                           7};
    for (const CellRect& rect : {changed, free.geometry().rect().grown(3)}) {
      const RectangleEdit edited = edit(map, free, rect);
      EXPECT_TRUE(edited.removed.empty());
      EXPECT_TRUE(edited.added.empty());
      EXPECT_EQ(map.rectangles(), before);
    }
  }
}

TEST(RectangleEdit, ThePublishedExampleComesBack) {
  FreeCells free = test::publishedExample();
  for (std::size_t i = 0; i < free.values().size(); ++i) {
    RectangleGraph map = mapOf(free);
    const Cell cell = free.geometry().cell(CellIndex(static_cast<std::uint32_t>(i)));
    const CellRect changed{cell.column, cell.row, 1, 1};
    free[cell] ^= 1;
    edit(map, free, changed);
    EXPECT_EQ(map.at(cell).has_value(), free[cell] != 0);
    free[cell] ^= 1;
    edit(map, free, changed);
    EXPECT_LE(map.count(), 10U);
    EXPECT_EQ(map.freeCells(), mapOf(free).freeCells());
  }
}

TEST(RectangleEdit, NumbersThatAreVacantAreUsedAgain) {
  FreeCells free(GridGeometry(40, 40, 1.0), 1);
  RectangleGraph map = mapOf(free);
  std::size_t most = 0;
  for (int i = 0; i < 200; ++i) {
    const Cell cell{i % 37, i % 31};
    free[cell] ^= 1;
    edit(map, free, {cell.column, cell.row, 1, 1});
    most = std::max(most, map.count());
    ASSERT_LE(map.rectangles().size(), most + 12);
  }
}

// --- Laws ---------------------------------------------------------------------------------------

void expectPartition(const FreeCells& free, const RectangleGraph& map) {
  ASSERT_TRUE(test::isPartition(free, present(map)));
  EXPECT_EQ(map.count(), present(map).size());
  for (int row = 0; row < free.height(); ++row)
    for (int column = 0; column < free.width(); ++column) {
      const auto number = map.at({column, row});
      ASSERT_EQ(number.has_value(), (free[Cell{column, row}]) != 0);
      ASSERT_TRUE(!number || map.rectangles()[*number].contains({column, row}));
    }
}

// Those of a map made of the same rectangles, but for the numbers.
void expectConnections(const RectangleGraph& map, Touching touching) {
  std::vector<std::uint32_t> numbers;  // that the fresh map's rectangles have in the edited one
  for (std::uint32_t i = 0; i < map.rectangles().size(); ++i)
    if (!map.rectangles()[i].empty()) numbers.push_back(i);
  const RectangleGraph fresh(map.geometry(), present(map), touching);
  EXPECT_EQ(map.connections().count(), fresh.connections().count());
  std::vector<char> seen(map.connections().size(), 0);
  for (std::uint32_t i = 0; i < numbers.size(); ++i) {
    std::vector<Connection> expected;
    for (Connection connection : fresh.connections().of(i)) {
      connection.to = numbers[connection.to];
      expected.push_back(connection);
    }
    const auto range = map.connections().of(numbers[i]);
    ASSERT_EQ(std::vector<Connection>(range.begin(), range.end()), expected);
    for (std::size_t number = 0; number < range.size(); ++number) {
      char& mark = seen[map.connections().firstOf(numbers[i]) + number];
      ASSERT_EQ(mark, 0);
      mark = 1;
    }
  }
  for (std::uint32_t i = 0; i < map.rectangles().size(); ++i) {
    ASSERT_TRUE(!map.rectangles()[i].empty() || map.connections().of(i).size() == 0);
  }
}

// What the edit says is what differs.
void expectEdit(const std::vector<CellRect>& before, const RectangleGraph& map,
                const RectangleEdit& edited) {
  std::vector<CellRect> was = before;
  was.resize(map.rectangles().size());
  for (std::uint32_t i = 0; i < was.size(); ++i) {
    const bool removed = std::binary_search(edited.removed.begin(), edited.removed.end(), i);
    const bool added = std::binary_search(edited.added.begin(), edited.added.end(), i);
    ASSERT_EQ(!was[i].empty() && !removed,
              !was[i].empty() && !removed && was[i] == map.rectangles()[i]);
    ASSERT_EQ(map.rectangles()[i].empty(), was[i].empty() ? !added : removed && !added);
  }
}

CellRect randomChange(std::mt19937& random, FreeCells& free) {
  const auto draw = [&random](int below) {
    return static_cast<int>(random() % static_cast<unsigned>(below));
  };
  const int largest = random() % 3 == 0 ? 9 : 1;
  const CellRect changed =
      CellRect{draw(free.width()), draw(free.height()), 1 + draw(largest), 1 + draw(largest)}
          .intersection(free.geometry().rect());
  const int kind = largest == 1 ? 3 : draw(4);
  for (int row = changed.row; row < changed.row + changed.height; ++row)
    for (int column = changed.column; column < changed.column + changed.width; ++column) {
      std::uint8_t& cell = free[Cell{column, row}];
      cell = static_cast<std::uint8_t>(kind == 0   ? 0
                                       : kind == 1 ? 1
                                       : kind == 2 ? random() % 2
                                                   : 1 - cell);
    }
  return changed;
}

TEST(RectangleEdit, LeavesAMapLikeOneMadeAnew) {
  std::mt19937 random(20261121);
  for (int trial = 0; trial < 60; ++trial) {
    SCOPED_TRACE(trial);
    FreeCells free = trial % 2 == 0 ? test::randomBlocks(random, 90)
                                    : test::randomFreeCells(random, 30, 0.1 * (trial % 11));
    const Touching touching = trial % 3 == 0 ? Touching::BORDERS_AND_CORNERS : Touching::BORDERS;
    RectangleGraph map = mapOf(free, touching);
    for (int step = 0; step < 40; ++step) {
      const std::vector<CellRect> before = map.rectangles();
      const CellRect changed = randomChange(random, free);
      // An update may say that more changed than did.
      const RectangleEdit edited = edit(map, free, changed.grown(trial % 4));
      expectEdit(before, map, edited);
      if (step % 8 != 7) continue;
      expectPartition(free, map);
      expectConnections(map, touching);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

// A town of 80 houses, of which cells are toggled: anywhere, and where walls are.
FreeCells town(std::mt19937& random) {
  FreeCells free(GridGeometry(250, 250, 1.0), 1);
  for (int house = 0; house < 80; ++house) {
    const CellRect rect{static_cast<int>(random() % 245), static_cast<int>(random() % 245),
                        5 + static_cast<int>(random() % 20), 5 + static_cast<int>(random() % 20)};
    test::fillCells(free, rect.intersection(free.geometry().rect()), 0);
  }
  return free;
}

bool besideAWall(const FreeCells& free, Cell cell) {
  int blocked = 0, cells = 0;
  for (int row = cell.row - 1; row <= cell.row + 1; ++row)
    for (int column = cell.column - 1; column <= cell.column + 1; ++column) {
      if (!free.contains({column, row})) continue;
      ++cells;
      blocked += free[Cell{column, row}] == 0 ? 1 : 0;
    }
  return 0 < blocked && blocked < cells;
}

TEST(RectangleEdit, KeepsAboutAsFewRectanglesAsAFreshDecomposition) {
  std::mt19937 random(20261122);
  for (const bool walls : {false, true}) {
    FreeCells free = town(random);
    BitMaps bits = bitMapsOf(free);
    RectangleGraph map = mapOf(free);
    for (int edits = 1; edits <= 10000; ++edits) {
      const Cell cell{static_cast<int>(random() % 250), static_cast<int>(random() % 250)};
      if (walls && !besideAWall(free, cell)) {
        --edits;
        continue;
      }
      free[cell] ^= 1;
      bits.rows.set(cell, free[cell] != 0);
      map.edit(bits.rows, {cell.column, cell.row, 1, 1}, StopToken());
      if (edits % 2500 == 0) {
        EXPECT_LE(static_cast<double>(map.count()), 1.1 * static_cast<double>(mapOf(free).count()));
      }
    }
  }
}

// Two maps that have nothing in common but their size.
TEST(RectangleEdit, TakesAWholeNewMap) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 30; ++trial) {
    const GridGeometry geometry(1 + static_cast<int>(random() % 80),
                                1 + static_cast<int>(random() % 80), 1.0);
    FreeCells before(geometry), after(geometry);
    for (auto* cells : {&before, &after})
      for (std::uint8_t& cell : cells->values()) cell = random() % 5 < random() % 6 ? 1 : 0;
    RectangleGraph map = mapOf(before);
    edit(map, after, geometry.rect());
    expectPartition(after, map);
    expectConnections(map, Touching::BORDERS);
  }
}

TEST(RectangleEdit, StopsWhenAskedAndMayBeCalledAgain) {
  std::mt19937 random(6);
  const GridGeometry geometry(700, 700, 1.0);
  FreeCells before(geometry, 1), after(geometry);
  for (std::uint8_t& cell : after.values()) cell = random() % 2 == 0 ? 1 : 0;
  RectangleGraph map = mapOf(before);
  const BitMaps bits = bitMapsOf(after);
  int stopped = 0;
  for (const double limit : {0.0, 0.01, 0.02, 0.04}) {
    const StopSource source;
    try {
      map.edit(bits.rows, geometry.rect(), source.token(std::chrono::duration<double>(limit)));
    } catch (const Stopped&) {
      ++stopped;
    }
  }
  EXPECT_GT(stopped, 0);
  map.edit(bits.rows, geometry.rect(), StopToken());
  expectPartition(after, map);
  expectConnections(map, Touching::BORDERS);
}

TEST(RectangleEdit, SameEditsSameRectangles) {
  std::mt19937 random(3);
  FreeCells free = test::randomBlocks(random, 120);
  RectangleGraph a = mapOf(free), b = mapOf(free);
  for (int step = 0; step < 100; ++step) {
    const CellRect changed = randomChange(random, free);
    edit(a, free, changed);
    edit(b, free, changed);
    ASSERT_EQ(a.rectangles(), b.rectangles());
  }
}

}  // namespace
}  // namespace grid_path_planner::planners
