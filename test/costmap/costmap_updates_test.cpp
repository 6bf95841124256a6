// What becomes of cost grids when the map changes: the newest is like a freshly made one, the ones
// handed out before stay as they were.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <random>

#include "grid_path_planner/costmap/costmap_builder.h"
#include "support/ascii_map.h"
#include "support/random_map.h"

namespace grid_path_planner::costmap {

using base::Stopped;
using base::StopSource;
using base::StopToken;
using grid::Cell;
using grid::CellIndex;
using grid::CellRect;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

using Costs = std::shared_ptr<const CostGrid>;

std::shared_ptr<const OccupancyGrid> shared(const std::vector<std::string>& lines) {
  return std::make_shared<const OccupancyGrid>(test::AsciiMap(lines).map);
}

Costs freshlyDownsampled(const OccupancyGrid& map, const CostmapOptions& options) {
  CostmapBuilder fresh(options);
  fresh.setMap(std::make_shared<const OccupancyGrid>(map));
  return fresh.downsampled(StopToken());
}

void expectSame(const CostGrid& updated, const CostGrid& fresh) {
  ASSERT_EQ(updated.weights(), fresh.weights());
  ASSERT_EQ(updated.classes(), fresh.classes());
  EXPECT_EQ(updated.minWeight(), fresh.minWeight());
  EXPECT_EQ(updated.maxWeight(), fresh.maxWeight());
  EXPECT_EQ(updated.uniform(), fresh.uniform());
  EXPECT_EQ(updated.bitMaps(StopToken()).rows, fresh.bitMaps(StopToken()).rows);
  EXPECT_EQ(updated.bitMaps(StopToken()).columns, fresh.bitMaps(StopToken()).columns);
  EXPECT_EQ(updated.original(), fresh.original());
  EXPECT_EQ(updated.kernel(), fresh.kernel());
}

CostmapOptions randomOptions(std::mt19937& random) {
  CostmapOptions options;
  options.kernel = 1 + static_cast<int>(random() % 4);
  options.kernel_rule = random() % 3 == 0 ? KernelRule::FILTER2D : KernelRule::CONSERVATIVE;
  options.radius = static_cast<double>(random() % 3) * 0.8;
  options.decay = static_cast<double>(random() % 2) * 0.7;
  options.free_weight = random() % 4 == 0 ? 60 : 1;
  options.unknown_is_passable = random() % 2 == 0;
  options.radius_to_unknown = static_cast<double>(random() % 4) * 0.9 - 1.0;
  options.outside = choicesOf(Outside{})[random() % 3].second;
  return options;
}

// Draws new values in a few rectangles of the map and gives them.
std::vector<CellRect> scribble(std::mt19937& random, OccupancyGrid& map) {
  const std::vector<CellRect> rects = test::randomRects(random, map.geometry(), 6);
  const std::int8_t values[] = {0, 0, 0, 100, -1, 10};
  for (const CellRect& each : rects) {
    const CellRect rect = each.intersection(map.geometry().rect());
    for (int row = rect.row; row < rect.row + rect.height; ++row)
      for (int column = rect.column; column < rect.column + rect.width; ++column)
        map[Cell{column, row}] = values[random() % 6];
  }
  return rects;
}

bool anyContains(const std::vector<CellRect>& rects, Cell cell) {
  return std::any_of(rects.begin(), rects.end(),
                     [cell](const CellRect& rect) { return rect.contains(cell); });
}

void expectOnlyThereDiffer(const CostGrid& before, const CostGrid& after,
                           const std::vector<CellRect>& changed) {
  for (std::uint32_t i = 0; i < after.geometry().size(); ++i)
    if (after.weights()[CellIndex(i)] != before.weights()[CellIndex(i)]) {
      ASSERT_TRUE(anyContains(changed, after.geometry().cell(CellIndex(i))));
    }
}

std::vector<CellRect> changeSince(const Costs& before, const CostmapBuilder& builder) {
  return builder.downsampledChanges().since(before->revision()).value().weights;
}

TEST(CostmapUpdates, AnEarlierGridDoesNotChange) {
  CostmapBuilder builder({});
  builder.setMap(shared({"...", "..."}));
  const Costs first = builder.fullResolution(StopToken());
  builder.updateMap(shared({"...", ".#."}), {{1, 1, 1, 1}});
  const Costs second = builder.fullResolution(StopToken());
  EXPECT_TRUE(first->passable({1, 1}));
  EXPECT_FALSE(second->passable({1, 1}));
  EXPECT_EQ(second->revision(), first->revision() + 1);
}

TEST(CostmapUpdates, TwoGridsAreReusedOnceNobodyHoldsThem) {
  CostmapBuilder builder({});
  builder.setMap(shared({"...", "..."}));
  const CostGrid* first = builder.fullResolution(StopToken()).get();
  builder.updateMap(shared({"..#", "..."}), {{2, 0, 1, 1}});
  Costs second = builder.fullResolution(StopToken());
  builder.updateMap(shared({"..#", "#.."}), {{0, 1, 1, 1}});
  EXPECT_EQ(builder.fullResolution(StopToken()).get(), first);
  builder.updateMap(shared({"...", "#.."}), {{2, 0, 1, 1}});
  EXPECT_NE(builder.fullResolution(StopToken()), second);  // it is held
}

TEST(CostmapUpdates, AnUpdateWithoutNewClassesKeepsTheGrid) {
  CostmapBuilder builder({});
  auto map = std::make_shared<OccupancyGrid>(test::AsciiMap({"...", "..."}).map);
  builder.setMap(map);
  const Costs before = builder.downsampled(StopToken());
  (*map)[Cell{1, 1}] = 7;  // free as before
  builder.updateMap(map, {map->geometry().rect()});
  EXPECT_EQ(builder.downsampled(StopToken()), before);
}

TEST(CostmapUpdates, AStoppedUpdateLosesNothing) {
  CostmapOptions options;
  options.radius = 3.0;
  options.kernel = 2;
  OccupancyGrid map(GridGeometry(300, 300, 1.0), 0);
  CostmapBuilder builder(options);
  builder.setMap(std::make_shared<const OccupancyGrid>(map));
  const Costs before = builder.downsampled(StopToken());
  for (std::uint32_t i = 0; i < map.values().size(); i += 900) map[CellIndex(i)] = 100;
  builder.updateMap(std::make_shared<const OccupancyGrid>(map), {map.geometry().rect()});
  StopSource source;
  source.cancel();
  EXPECT_THROW(builder.downsampled(source.token()), Stopped);
  EXPECT_TRUE(before->passable({0, 0}));
  expectSame(*builder.downsampled(StopToken()), *freshlyDownsampled(map, options));
}

TEST(CostmapUpdates, StoppedWhileItIsMadeReadyForChangesItLosesNothing) {
  OccupancyGrid map(GridGeometry(300, 300, 1.0), 0);
  CostmapBuilder builder({});
  builder.makeReadyForChanges(StopToken());  // of no map
  builder.setMap(std::make_shared<const OccupancyGrid>(map));
  builder.makeReadyForChanges(StopToken());  // nothing is made yet
  const Costs before = builder.downsampled(StopToken());
  StopSource source;
  source.cancel();
  EXPECT_THROW(builder.makeReadyForChanges(source.token()), Stopped);
  map[Cell{7, 7}] = 100;
  builder.updateMap(std::make_shared<const OccupancyGrid>(map), {{7, 7, 1, 1}});
  expectSame(*builder.downsampled(StopToken()), *freshlyDownsampled(map, {}));
  EXPECT_TRUE(before->passable({7, 7}));
}

// What a sensor sees change: everything in a rectangle becomes `to`, where it was one of `from`.
struct Seen {
  std::vector<std::int8_t> from;
  std::int8_t to;
};

CellRect see(std::mt19937& random, const Seen& seen, OccupancyGrid& map) {
  const Cell low = test::randomCell(random, map.geometry());
  const CellRect rect = CellRect{low.column - 3, low.row - 3, 1 + static_cast<int>(random() % 10),
                                 1 + static_cast<int>(random() % 10)}
                            .intersection(map.geometry().rect());
  for (int row = rect.row; row < rect.row + rect.height; ++row)
    for (int column = rect.column; column < rect.column + rect.width; ++column) {
      std::int8_t& value = map[Cell{column, row}];
      if (std::find(seen.from.begin(), seen.from.end(), value) != seen.from.end()) value = seen.to;
    }
  return rect;
}

TEST(CostmapUpdatesLaw, EqualsAFreshGridAfterEveryKindOfChange) {
  const std::vector<Seen> kinds = {{{0, -1}, 100}, {{0}, 100}, {{100}, 0},     {{100, -1}, 0},
                                   {{-1}, 0},      {{0}, -1},  {{100, 0}, -1}, {{100}, -1}};
  struct Rings {
    double radius;
    double decay;
    int inflation_weight;
  };
  std::mt19937 random(17);
  for (const Rings& rings : {Rings{0, 0, 40}, Rings{0, 0.4, 40}, Rings{3.5, 0, 40},
                             Rings{2, 0.5, 40}, Rings{1, 0.3, 90}, Rings{0.5, 30, 40}}) {
    SCOPED_TRACE("radius " + std::to_string(rings.radius) + " decay " +
                 std::to_string(rings.decay));
    for (int trial = 0; trial < 24; ++trial) {
      OccupancyGrid map = test::randomOccupancy(random, 60, trial % 3 * 0.02, 0.1);
      CostmapOptions options;
      options.radius = rings.radius;
      options.decay = rings.decay;
      options.inflation_weight = rings.inflation_weight;
      options.occupied_is_passable = rings.radius == 0.0 && trial % 4 == 3;
      options.unknown_is_passable = trial % 2 == 0;
      options.unknown_weight = trial % 5 == 0 ? 1 : 50;
      options.free_weight = trial % 7 == 0 ? 45 : 1;
      options.kernel = 1 + trial % 3 / 2;
      options.radius_to_unknown = trial % 6 == 5 ? 2.2 : -1.0;
      options.outside = choicesOf(Outside{})[trial % 3].second;
      CostmapBuilder builder(options);
      builder.setMap(std::make_shared<const OccupancyGrid>(map));
      for (int edit = 0; edit < 12; ++edit) {
        const Costs before = builder.downsampled(StopToken());
        for (unsigned i = 0; i <= random() % 4 / 3; ++i) {
          std::vector<CellRect> changed;
          for (unsigned places = 1 + random() % 3; places > 0; --places)
            changed.push_back(see(random, kinds[random() % kinds.size()], map));
          builder.updateMap(std::make_shared<const OccupancyGrid>(map), changed);
        }
        const Costs after = builder.downsampled(StopToken());
        expectSame(*after, *freshlyDownsampled(map, options));
        if (HasFatalFailure()) return;
        expectOnlyThereDiffer(*before, *after, changeSince(before, builder));
      }
    }
  }
}

// A hull around two edits at opposite corners would be the map, and take as long.
TEST(CostmapUpdates, EditsFarApartChangeTheirSurroundingsOnly) {
  CostmapOptions options;
  options.radius = 2.0;
  CostmapBuilder builder(options);
  OccupancyGrid map(GridGeometry(500, 400, 1.0), 0);
  builder.setMap(std::make_shared<const OccupancyGrid>(map));
  builder.downsampled(StopToken());
  map[Cell{0, 0}] = map[Cell{499, 399}] = map[Cell{250, 100}] = 100;
  builder.updateMap(std::make_shared<const OccupancyGrid>(map), {map.geometry().rect()});
  expectSame(*builder.downsampled(StopToken()), *freshlyDownsampled(map, options));
  const Costs before = builder.downsampled(StopToken());
  for (const Cell each : {Cell{0, 0}, Cell{499, 399}}) map[each] = 0;
  builder.updateMap(std::make_shared<const OccupancyGrid>(map),
                    {{0, 0, 1, 1}, {499, 399, 1, 1}, {250, 100, 1, 1}});
  expectSame(*builder.downsampled(StopToken()), *freshlyDownsampled(map, options));
  EXPECT_EQ(changeSince(before, builder), (std::vector<CellRect>{{0, 0, 3, 3}, {497, 397, 3, 3}}));
}

// As a map that is published again differs: here and there, from a few cells to whole areas.
TEST(CostmapUpdatesLaw, EqualsAFreshGridAfterChangesAllOverTheMap) {
  std::mt19937 random(31);
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const GridGeometry geometry(100 + int(random() % 300), 100 + int(random() % 300), 1.0);
    OccupancyGrid map(geometry, 0);
    CostmapOptions options = randomOptions(random);
    options.radius = trial % 3 * 2.5;
    options.decay = trial % 2 * 0.5;
    options.occupied_is_passable = trial % 6 == 3;
    CostmapBuilder builder(options);
    builder.setMap(std::make_shared<const OccupancyGrid>(map));
    for (const std::size_t share : {20U, 1000U, 300U, 30U, 5U, 2000U}) {
      const Costs before = builder.downsampled(StopToken());
      const std::int8_t values[] = {100, 100, 0, -1};
      for (std::size_t i = 0; i < geometry.size() / share; ++i)
        map[test::randomCell(random, geometry)] = values[random() % 4];
      builder.updateMap(std::make_shared<const OccupancyGrid>(map), {geometry.rect()});
      const Costs after = builder.downsampled(StopToken());
      expectSame(*after, *freshlyDownsampled(map, options));
      expectOnlyThereDiffer(*before, *after, changeSince(before, builder));
      if (HasFatalFailure()) return;
    }
  }
}

// Only what a sensor makes occupied, or no longer so, reaches farther than it.
TEST(CostmapUpdates, AChangeReachesNoFartherThanInflation) {
  CostmapOptions options;
  options.radius = 2.0;
  CostmapBuilder builder(options);
  OccupancyGrid map(GridGeometry(20, 20, 1.0), -1);
  const auto changeAfter = [&](std::int8_t value) {
    const Costs before = builder.downsampled(StopToken());
    map[Cell{10, 10}] = value;
    builder.updateMap(std::make_shared<const OccupancyGrid>(map), {map.geometry().rect()});
    builder.downsampled(StopToken());
    return changeSince(before, builder);
  };
  builder.setMap(std::make_shared<const OccupancyGrid>(map));
  builder.downsampled(StopToken());
  using Rects = std::vector<CellRect>;
  EXPECT_EQ(changeAfter(0), (Rects{{10, 10, 1, 1}}));
  EXPECT_EQ(changeAfter(-1), (Rects{{10, 10, 1, 1}}));
  EXPECT_EQ(changeAfter(100), (Rects{{8, 8, 5, 5}}));
  EXPECT_EQ(changeAfter(0), (Rects{{8, 8, 5, 5}}));
}

TEST(CostmapUpdatesLaw, EqualsAFreshGridAfterUpdatesAndEarlierGridsStay) {
  struct Held {
    Costs costs;
    CostGrid copy;
  };
  std::mt19937 random(9);
  for (int trial = 0; trial < 80; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    OccupancyGrid map = test::randomOccupancy(random, 50, 0.04, 0.1);
    const CostmapOptions options = randomOptions(random);
    CostmapBuilder builder(options);
    builder.setMap(std::make_shared<const OccupancyGrid>(map));
    std::deque<Held> held;
    for (int edit = 0; edit < 12; ++edit) {
      const Costs before = builder.downsampled(StopToken());
      held.push_back({before, *before});
      if (random() % 2 == 0) builder.makeReadyForChanges(StopToken());
      while (random() % 2 == 0 && !held.empty()) held.pop_front();

      for (unsigned i = 0; i <= random() % 3; ++i) {
        const std::vector<CellRect> changed = scribble(random, map);
        builder.updateMap(std::make_shared<const OccupancyGrid>(map), changed);
      }
      const Costs after = builder.downsampled(StopToken());
      expectSame(*after, *freshlyDownsampled(map, options));
      for (const Held& each : held) {
        ASSERT_EQ(each.costs->weights(), each.copy.weights());
        ASSERT_EQ(each.costs->classes(), each.copy.classes());
        ASSERT_EQ(each.costs->revision(), each.copy.revision());
        ASSERT_EQ(each.costs->bitMaps(StopToken()).rows,
                  BitMaps(each.copy.weights(), StopToken()).rows);
      }
      if (after == before) continue;
      EXPECT_EQ(after->revision(), before->revision() + 1);
      expectOnlyThereDiffer(*before, *after, changeSince(before, builder));
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::costmap
