#include "costmap/inflation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/costmap/costmap_builder.h"
#include "support/ascii_map.h"
#include "support/cost_maps.h"
#include "support/random_map.h"

namespace grid_path_planner::costmap {

using base::InputError;
using grid::Cell;
using grid::CellIndex;
using grid::GridGeometry;
using grid::OccupancyGrid;
using test::costsOf;

namespace {

// Metres from a cell's centre to the nearest edge of a cell that is one, by looking at all of them.
template <class IsOne>
double distanceByBruteForce(const OccupancyGrid& map, Cell cell, const IsOne& is_one) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < map.values().size(); ++i) {
    if (!is_one(map.values()[i])) continue;
    const Cell other = map.geometry().cell(CellIndex(i));
    const double x = std::max(std::abs(other.column - cell.column) - 0.5, 0.0);
    const double y = std::max(std::abs(other.row - cell.row) - 0.5, 0.0);
    nearest = std::min(nearest, std::hypot(x, y) * map.geometry().resolution());
  }
  return nearest;
}

double distanceToBorder(const OccupancyGrid& map, Cell cell) {
  const int cells =
      std::min({cell.column, cell.row, map.width() - 1 - cell.column, map.height() - 1 - cell.row});
  return (cells + 0.5) * map.geometry().resolution();
}

int weightByDefinition(const OccupancyGrid& map, Cell cell, const CostmapOptions& options) {
  const int value = map[cell];
  const bool unknown = value < 0 || (value > 25 && value < 65);
  double distance = distanceByBruteForce(map, cell, [](int other) { return other >= 65; });
  if (options.outside == Outside::OCCUPIED)
    distance = std::min(distance, distanceToBorder(map, cell));
  const auto nearer = [](double at, double radius) { return at < radius * (1.0 - 1e-9); };
  if (value >= 65 || nearer(distance, options.radius)) return 0;
  if (unknown && !options.unknown_is_passable) return 0;

  double to_unknown = distanceByBruteForce(
      map, cell, [](int other) { return other < 0 || (other > 25 && other < 65); });
  if (options.outside == Outside::UNKNOWN)
    to_unknown = std::min(to_unknown, distanceToBorder(map, cell));
  const bool by_default = options.radius_to_unknown < 0.0;
  const double default_radius = options.unknown_is_passable ? 0.0 : options.radius;
  if (nearer(to_unknown, by_default ? default_radius : options.radius_to_unknown)) return 0;

  const int weight = unknown ? options.unknown_weight : options.free_weight;
  if (options.decay == 0.0 || std::isinf(distance)) return weight;
  const double ring =
      options.free_weight + (options.inflation_weight - options.free_weight) *
                                std::exp(-options.decay * (distance - options.radius));
  return std::max(weight, static_cast<int>(std::lround(ring)));
}

TEST(Inflation, BlocksWhatIsNearerThanTheRadiusAndNotWhatIsAtIt) {
  const OccupancyGrid map = test::AsciiMap({"#......"}, 0.1).map;
  CostmapOptions options;
  options.radius = 0.25;  // the edge is at 0.1 m: centres at 0.05, 0.15, 0.25 from it
  const auto costs = costsOf(map, options);
  EXPECT_FALSE(costs->passable({1, 0}));
  EXPECT_FALSE(costs->passable({2, 0}));
  EXPECT_TRUE(costs->passable({3, 0}));
}

// A resolution of 0.03 arrives as a 32-bit float, 0.0299999993: ten cells and a half must not
// become less than 0.315 m.
TEST(Inflation, RoundingOfTheResolutionBlocksNothing) {
  const OccupancyGrid map = test::AsciiMap({"#..............."}, double(0.03F)).map;
  CostmapOptions options;
  options.radius = 0.315;
  const auto costs = costsOf(map, options);
  EXPECT_FALSE(costs->passable({10, 0}));
  EXPECT_TRUE(costs->passable({11, 0}));
}

TEST(Inflation, UnknownDoesNotInflate) {
  CostmapOptions options;
  options.radius = 2.0;
  options.decay = 1.0;
  const auto costs = costsOf(test::AsciiMap({"?.."}).map, options);
  EXPECT_EQ(costs->weight({1, 0}), 1);
  EXPECT_EQ(costs->weight({0, 0}), 50);
}

TEST(Inflation, WeightFallsFromTheRadiusOn) {
  CostmapOptions options;
  options.radius = 0.5;
  options.decay = 1.0;
  const auto costs = costsOf(test::AsciiMap({"#....."}).map, options);
  EXPECT_EQ(costs->weight({1, 0}), 40);  // at the radius
  EXPECT_EQ(costs->weight({2, 0}), std::lround(1 + 39 * std::exp(-1.0)));
  EXPECT_EQ(costs->weight({3, 0}), std::lround(1 + 39 * std::exp(-2.0)));
}

// Paths ran along the very border of the map, 0.05 m from the end of the world with a radius of 0.6.
TEST(Inflation, KeepsTheRadiusFromTheBorderWhereThatIsAskedFor) {
  const OccupancyGrid map(GridGeometry(7, 5, 1.0), 0);
  CostmapOptions options;
  options.radius = 1.5;
  EXPECT_TRUE(costsOf(map, options)->passable({0, 0}));
  options.outside = Outside::OCCUPIED;
  const auto costs = costsOf(map, options);
  EXPECT_FALSE(costs->passable({0, 2}));
  EXPECT_FALSE(costs->passable({3, 4}));
  EXPECT_TRUE(costs->passable({1, 1}));
}

TEST(Inflation, KeepsTheRadiusFromUnknownCellsAndTheBorderWhereUnknownIsNotPassable) {
  const OccupancyGrid map = test::AsciiMap({".......", ".......", ".......", "......?"}).map;
  CostmapOptions options;
  options.radius = 1.0;
  options.unknown_is_passable = false;
  const auto costs = costsOf(map, options);
  EXPECT_FALSE(costs->passable({5, 2}));
  EXPECT_FALSE(costs->passable({0, 1}));
  EXPECT_TRUE(costs->passable({4, 2}));
  options.radius_to_unknown = 0.0;
  const auto free_ends = costsOf(map, options);
  EXPECT_TRUE(free_ends->passable({5, 3}));
  EXPECT_TRUE(free_ends->passable({0, 1}));
}

TEST(Inflation, RefusesWhatContradictsItself) {
  CostmapOptions options;
  options.occupied_is_passable = true;
  EXPECT_NO_THROW(CostmapBuilder{options});
  options.radius = 0.1;
  EXPECT_THROW(CostmapBuilder{options}, InputError);
  options = CostmapOptions();
  options.thresholds.free_max = 65;
  EXPECT_THROW(CostmapBuilder{options}, InputError);
  options = CostmapOptions();
  options.free_weight = 0;
  EXPECT_THROW(CostmapBuilder{options}, InputError);
  options.free_weight = 65536;
  EXPECT_THROW(CostmapBuilder{options}, InputError);
  options = CostmapOptions();
  options.radius = std::nan("");
  EXPECT_THROW(CostmapBuilder{options}, InputError);
}

TEST(InflationLaw, WeightsAreThoseOfTheDefinition) {
  std::mt19937 random(42);
  for (int trial = 0; trial < 60; ++trial) {
    const OccupancyGrid map = test::randomOccupancy(random, 40, trial % 3 == 0 ? 0.01 : 0.08, 0.2);
    CostmapOptions options;
    options.radius = trial % 4 * 0.9;
    options.decay = trial % 5 * 0.3;
    options.unknown_is_passable = trial % 2 == 0;
    options.radius_to_unknown = trial % 7 == 6 ? 1.3 : trial % 7 == 5 ? 0.2 : -1.0;
    options.outside = choicesOf(Outside{})[trial % 3].second;
    const auto costs = costsOf(map, options);
    for (std::uint32_t i = 0; i < map.values().size(); ++i) {
      const Cell cell = map.geometry().cell(CellIndex(i));
      ASSERT_EQ(costs->weight(cell), weightByDefinition(map, cell, options))
          << "trial " << trial << " cell " << cell;
    }
  }
}

// Beyond a reach of 63 cells another transform takes over.
TEST(InflationLaw, WeightsAreThoseOfTheDefinitionAtEveryReach) {
  std::mt19937 random(43);
  for (const double reach : {1.0, 2.5, 30.0, 61.0, 62.0, 63.0, 64.0, 100.0}) {
    OccupancyGrid map(GridGeometry(300, 4, 1.0), 0);
    for (int obstacle = 0; obstacle < 3; ++obstacle)
      map[test::randomCell(random, map.geometry())] = 100;
    CostmapOptions options;
    options.radius = reach / 2.0;
    options.decay = 4.4 / (reach / 2.0);  // 39 e^-4.4 is below a half
    const auto costs = costsOf(map, options);
    for (std::uint32_t i = 0; i < map.values().size(); ++i) {
      const Cell cell = map.geometry().cell(CellIndex(i));
      ASSERT_EQ(costs->weight(cell), weightByDefinition(map, cell, options))
          << "reach " << reach << " cell " << cell;
    }
  }
}

// PX4-Avoidance PR#384: gaps too narrow for the vehicle.
TEST(InflationLaw, EveryPassableCellIsAtLeastTheRadiusAway) {
  std::mt19937 random(384);
  for (int trial = 0; trial < 40; ++trial) {
    const OccupancyGrid map = test::randomOccupancy(random, 40, 0.05, 0.1);
    CostmapOptions options;
    options.radius = std::uniform_real_distribution<double>(0.0, 4.0)(random);
    const auto costs = costsOf(map, options);
    for (std::uint32_t i = 0; i < map.values().size(); ++i) {
      const Cell cell = map.geometry().cell(CellIndex(i));
      if (costs->passable(cell)) {
        ASSERT_GE(distanceByBruteForce(map, cell, [](int value) { return value >= 65; }),
                  options.radius);
      }
    }
  }
}

}  // namespace
}  // namespace grid_path_planner::costmap
