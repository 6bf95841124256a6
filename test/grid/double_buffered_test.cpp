#include "grid_path_planner/grid/double_buffered.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <random>
#include <set>
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

// One who plans seldom keeps an old map; what the others need to see must not cost a whole copy each.
TEST(DoubleBuffered, AThirdMapTakesPartWhileAnOldOneIsHeld) {
  Maps maps;
  maps.reset(freeMap());
  const auto held = maps.current();
  std::set<const OccupancyGrid*> seen;
  for (std::int8_t value = 10; value < 30; ++value) {
    write(maps, value);
    seen.insert(maps.current().get());
    EXPECT_EQ(sumOf(*maps.current()), 4 * value);
  }
  EXPECT_EQ(sumOf(*held), 0);
  EXPECT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen.count(held.get()), 0u);
  EXPECT_EQ(maps.buffers(), 3u);
}

// The first change of a map of 4096x4096 cells took 0.35 s, nearly all of it for the copy.
TEST(DoubleBuffered, ASpareThatWasMadeBeforeTakesThePlaceOfACopy) {
  Maps maps;
  const OccupancyGrid* spare = nullptr;
  int copies = 0;
  const auto copy = [&](const OccupancyGrid& map) {
    ++copies;
    auto made = std::make_unique<OccupancyGrid>(map);
    spare = made.get();
    return made;
  };
  maps.makeSpare(copy);
  EXPECT_EQ(copies, 0) << "there is no map yet";
  maps.reset(freeMap());
  const auto first = maps.current();
  maps.makeSpare(copy);
  maps.makeSpare(copy);
  EXPECT_EQ(copies, 1) << "one is enough";
  write(maps, 10);
  EXPECT_EQ(maps.current().get(), spare);
  EXPECT_EQ(sumOf(*maps.current()), 40);
  maps.makeSpare(copy);
  EXPECT_EQ(copies, 2) << "the first map is held";
  write(maps, 20);
  EXPECT_EQ(maps.current().get(), spare);
  EXPECT_EQ(sumOf(*maps.current()), 80);
  EXPECT_EQ(sumOf(*first), 0);
}

TEST(DoubleBuffered, ACopyThatThrowsChangesNothing) {
  Maps maps;
  maps.reset(freeMap());
  const auto copy = [](const OccupancyGrid&) -> std::unique_ptr<OccupancyGrid> { throw 7; };
  EXPECT_THROW(maps.makeSpare(copy), int);
  write(maps, 10);
  EXPECT_EQ(sumOf(*maps.current()), 40);
}

TEST(DoubleBuffered, TellsWhatChangedSinceARevision) {
  Maps maps, other;
  maps.reset(freeMap());
  other.reset(freeMap());
  const std::uint64_t first = maps.revision();
  const auto put = [&maps](Cell cell) {
    maps.advance({{cell.column, cell.row, 1, 1}}, [&](OccupancyGrid& next) { next[cell] = 100; });
  };
  put({1, 1});
  const ChangeLog<> early = maps.changes();
  put({7, 3});
  using Rects = std::vector<CellRect>;
  EXPECT_EQ(maps.changes().since(first), (Rects{{1, 1, 1, 1}, {7, 3, 1, 1}}));
  EXPECT_EQ(maps.changes().since(first + 1), (Rects{{7, 3, 1, 1}}));
  EXPECT_EQ(maps.changes().since(first + 2), Rects());
  EXPECT_EQ(maps.changes().since(first + 3), std::nullopt) << "not yet";
  EXPECT_EQ(maps.changes().since(other.revision()), std::nullopt) << "another series";
  EXPECT_EQ(early.since(first), (Rects{{1, 1, 1, 1}})) << "a copy stays";
  for (std::size_t i = 2; i < ChangeLog<>::kMost; ++i) put({0, 0});
  EXPECT_TRUE(maps.changes().since(first));
  put({0, 0});
  EXPECT_EQ(maps.changes().since(first), std::nullopt) << "too long ago";
  maps.reset(freeMap());
  EXPECT_EQ(maps.changes().since(first + 5), std::nullopt) << "before a new series";
}

// Readers hold maps for as long as they like.
TEST(DoubleBufferedLaw, EveryMapIsWhatWasWrittenWhoeverHoldsWhat) {
  std::mt19937 random(18);
  for (int trial = 0; trial < 100; ++trial) {
    Maps maps;
    OccupancyGrid expected = *freeMap();
    maps.reset(freeMap());
    struct Held {
      std::shared_ptr<const OccupancyGrid> map;
      OccupancyGrid copy;
      std::uint64_t revision;
    };
    std::vector<Held> held;
    for (int edit = 0; edit < 40; ++edit) {
      if (random() % 2 == 0) held.push_back({maps.current(), expected, maps.revision()});
      while (!held.empty() && random() % 3 == 0) held.erase(held.begin() + random() % held.size());
      const CellRect rect{int(random() % 7), int(random() % 3), 2, 2};
      const auto value = static_cast<std::int8_t>(random() % 100);
      if (random() % 4 == 0)
        maps.makeSpare([](const auto& map) { return std::make_unique<OccupancyGrid>(map); });
      maps.advance({rect}, [&](OccupancyGrid& next) {
        ASSERT_EQ(next, expected);
        next[{rect.column, rect.row}] = next[{rect.column + 1, rect.row + 1}] = value;
      });
      expected[{rect.column, rect.row}] = expected[{rect.column + 1, rect.row + 1}] = value;
      ASSERT_EQ(*maps.current(), expected);
      for (const Held& each : held) {
        ASSERT_EQ(*each.map, each.copy);
        const auto changed = maps.changes().since(each.revision);
        if (!changed) continue;
        OccupancyGrid caught_up = each.copy;
        copyCells(expected, *changed, caught_up);
        ASSERT_EQ(caught_up, expected);
      }
    }
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
