#include "grid_path_planner/grid/double_buffered.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <thread>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::grid {
namespace {

using Maps = DoubleBuffered<OccupancyGrid>;

// The last of eight columns: of eight bytes the thread sanitizer remembers the four that were read last.
const CellRect kSomeCells{6, 0, 2, 2};

std::unique_ptr<OccupancyGrid> freeMap() {
  return std::make_unique<OccupancyGrid>(GridGeometry(8, 4, 1.0));
}

void write(Maps& maps, std::int8_t value) {
  maps.advance({kSomeCells}, [&](OccupancyGrid& next) {
    for (int row = 0; row < kSomeCells.height; ++row)
      for (int column = 6; column < 8; ++column) next[{column, row}] = value;
  });
}

int sumOf(const OccupancyGrid& map) {
  return std::accumulate(map.values().begin(), map.values().end(), 0);
}

TEST(DoubleBuffered, AMapThatIsHeldStaysAsItWas) {
  Maps maps;
  EXPECT_EQ(maps.current(), nullptr);
  maps.reset(freeMap());
  const auto first = maps.current();
  write(maps, 10);
  const auto second = maps.current();
  write(maps, 20);
  write(maps, 30);
  EXPECT_EQ(sumOf(*first), 0);
  EXPECT_EQ(sumOf(*second), 40);
  EXPECT_EQ(sumOf(*maps.current()), 120);
}

TEST(DoubleBuffered, TwoMapsTakeTurnsOnceNobodyHoldsThem) {
  Maps maps;
  maps.reset(freeMap());
  const OccupancyGrid* first = maps.current().get();
  write(maps, 10);
  const OccupancyGrid* second = maps.current().get();
  EXPECT_NE(first, second);
  for (std::int8_t value = 11; value < 20; ++value) {
    write(maps, value);
    EXPECT_EQ(maps.current().get(), value % 2 == 1 ? first : second);
    EXPECT_EQ(sumOf(*maps.current()), 4 * value);
  }
}

TEST(DoubleBuffered, AMapThatIsHeldOutlivesTheSeries) {
  std::shared_ptr<const OccupancyGrid> held;
  {
    Maps maps;
    maps.reset(freeMap());
    held = maps.current();
    write(maps, 10);
  }
  EXPECT_EQ(sumOf(*held), 0);
}

// The planner's thread reads a map and lets go of it, the subscriber's writes the next one into it. A
// fence ordered the two for the processor; scripts/test --thread-sanitize, which knows no fences,
// called it a race. The flag is relaxed, so that nothing here orders them but the maps themselves.
TEST(DoubleBuffered, WhatAnotherThreadReadHappensBeforeTheNextWrite) {
  Maps maps;
  maps.reset(freeMap());
  for (int round = 0; round < 20; ++round) {
    std::atomic<bool> read{false};
    std::thread reader([&, map = maps.current()]() mutable {
      EXPECT_EQ(sumOf(*map) % 4, 0);
      map.reset();
      read.store(true, std::memory_order_relaxed);
    });
    while (!read.load(std::memory_order_relaxed)) std::this_thread::yield();
    write(maps, 10);
    write(maps, 20);
    reader.join();
    EXPECT_EQ(sumOf(*maps.current()), 80);
  }
}

}  // namespace
}  // namespace grid_path_planner::grid
