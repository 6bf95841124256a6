// Bit maps say of every cell and of every cell beside the map what the weights say, after any
// edits.
#include "grid_path_planner/costmap/bit_maps.h"

#include <gtest/gtest.h>

#include <thread>

#include "grid_path_planner/costmap/cost_grid.h"
#include "support/cost_maps.h"
#include "support/random_map.h"

namespace grid_path_planner::costmap {

using base::Stopped;
using base::StopSource;
using base::StopToken;
using grid::Cell;
using grid::CellRect;
using grid::Grid;
using grid::GridGeometry;
using test::costMap;

namespace {

Grid<CostGrid::Weight> halfBlocked(std::mt19937& random, int width, int height) {
  Grid<CostGrid::Weight> weights(GridGeometry(width, height, 1.0));
  for (auto& weight : weights.values())
    weight = static_cast<CostGrid::Weight>(random() % 2 * 0x8000U);
  return weights;
}

void expectBits(const BitMaps& bits, const Grid<CostGrid::Weight>& weights) {
  ASSERT_EQ(bits.rows.width(), weights.width());
  ASSERT_EQ(bits.rows.height(), weights.height());
  ASSERT_EQ(bits.columns.width(), weights.height());
  ASSERT_EQ(bits.columns.height(), weights.width());
  for (int row = -1; row <= weights.height(); ++row)
    for (int column = -1; column <= weights.width(); ++column) {
      const Cell cell{column, row};
      const bool passable = weights.contains(cell) && weights[cell] != CostGrid::kBlocked;
      ASSERT_EQ((bits.rows[{column, row}]), passable) << cell;
      ASSERT_EQ((bits.columns[{row, column}]), passable) << cell;
    }
}

// The words beside a row, and the bits of its last word beyond the width.
void expectZerosAround(const BitMap& bits) {
  for (int row = -1; row <= bits.height(); ++row) {
    EXPECT_EQ(bits.row(row)[-1], 0U);
    EXPECT_EQ(bits.row(row)[bits.words()], 0U);
    for (int column = bits.width(); column < bits.words() * BitMap::kWordBits; ++column)
      EXPECT_FALSE((bits[{column, row}]));
  }
}

TEST(BitMaps, AreTheMapAndItsTransposeOnEverySize) {
  std::mt19937 random(1);
  for (const int width : {1, 2, 63, 64, 65, 127, 128, 200})
    for (const int height : {1, 3, 64, 65, 130}) {
      const Grid<CostGrid::Weight> weights = halfBlocked(random, width, height);
      const BitMaps bits(weights, StopToken());
      expectBits(bits, weights);
      expectZerosAround(bits.rows);
      expectZerosAround(bits.columns);
      EXPECT_EQ(bits.bytes(), BitMaps::bytesFor(weights.geometry()));
    }
}

TEST(BitMaps, AreAfterEditsAsIfMadeAnew) {
  std::mt19937 random(2);
  Grid<CostGrid::Weight> weights = halfBlocked(random, 190, 140);
  BitMaps bits(weights, StopToken());
  for (int edit = 0; edit < 200; ++edit) {
    const Cell low = test::randomCell(random, weights.geometry());
    const CellRect changed{low.column - 2, low.row - 2, 1 + int(random() % 90),
                           1 + int(random() % 90)};
    const CellRect inside = changed.intersection(weights.geometry().rect());
    for (int row = inside.row; row < inside.row + inside.height; ++row)
      for (int column = inside.column; column < inside.column + inside.width; ++column)
        weights[Cell{column, row}] = static_cast<CostGrid::Weight>(random() % 3);
    bits.update(weights, changed, StopToken());
    const BitMaps fresh(weights, StopToken());
    ASSERT_TRUE(bits.rows == fresh.rows && bits.columns == fresh.columns) << "edit " << edit;
  }
  bits.update(weights, {500, 500, 3, 3}, StopToken());
  expectBits(bits, weights);
}

TEST(BitMaps, OfAMapAreMadeOnceForAllWhoAsk) {
  std::mt19937 random(3);
  const Grid<CostGrid::Weight> weights = halfBlocked(random, 300, 200);
  const CostGrid map = costMap(weights);
  const std::size_t before = map.bytes();
  std::vector<const BitMaps*> seen(4);
  std::vector<std::thread> threads;
  for (const BitMaps*& each : seen)
    threads.emplace_back([&map, &each] { each = &map.bitMaps(StopToken()); });
  for (std::thread& asker : threads) asker.join();
  for (const BitMaps* each : seen) EXPECT_EQ(each, seen.front());
  expectBits(*seen.front(), weights);
  EXPECT_EQ(map.bytes(), before + seen.front()->bytes());
}

TEST(BitMaps, ThatWereStoppedAreMadeAtTheNextAsking) {
  std::mt19937 random(4);
  const Grid<CostGrid::Weight> weights = halfBlocked(random, 10, 700);
  const CostGrid map = costMap(weights);
  StopSource source;
  source.cancel();
  EXPECT_THROW(map.bitMaps(source.token()), Stopped);
  expectBits(map.bitMaps(StopToken()), weights);
}

TEST(CostGrid, IsUniformWhereAllPassableCellsWeighTheSame) {
  Grid<CostGrid::Weight> weights(GridGeometry(3, 2, 1.0), 7);
  EXPECT_TRUE(costMap(weights).uniform());
  weights[Cell{1, 1}] = CostGrid::kBlocked;
  EXPECT_TRUE(costMap(weights).uniform());
  EXPECT_EQ(costMap(weights).minWeight(), 7);
  weights[Cell{2, 1}] = 8;
  EXPECT_FALSE(costMap(weights).uniform());
  EXPECT_EQ(costMap(weights).minWeight(), 7);
  EXPECT_TRUE(costMap(Grid<CostGrid::Weight>(GridGeometry(3, 2, 1.0))).uniform());
  EXPECT_EQ(costMap(Grid<CostGrid::Weight>(GridGeometry(3, 2, 1.0))).minWeight(), 0);
}

}  // namespace
}  // namespace grid_path_planner::costmap
