#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid_path_planner/path/metrics.h"
#include "support/ascii_map.h"
#include "support/path_through.h"

namespace grid_path_planner::path {

using grid::OccupancyGrid;

namespace {

using test::pathThrough;

TEST(Crossing, SplitsALineAtTheCells) {
  const OccupancyGrid map = test::AsciiMap({".?#."}, 0.5).map;
  const ClassLengths lengths = lengthsByClass(pathThrough({{0.25, 0.25}, {1.75, 0.25}}), map, {});
  EXPECT_NEAR(lengths.free_m, 0.5, 1e-12);
  EXPECT_NEAR(lengths.unknown_m, 0.5, 1e-12);
  EXPECT_NEAR(lengths.occupied_m, 0.5, 1e-12);
}

TEST(Crossing, ADiagonalThroughALatticePointMeetsTwoCells) {
  const OccupancyGrid map = test::AsciiMap({".#",  //
                                            "#."})
                                .map;
  const ClassLengths lengths = lengthsByClass(pathThrough({{0.5, 0.5}, {1.5, 1.5}}), map, {});
  EXPECT_NEAR(lengths.free_m, std::sqrt(2.0), 1e-12);
  EXPECT_EQ(lengths.occupied_m, 0.0);
}

TEST(Crossing, OutsideTheMapIsInNoClass) {
  const OccupancyGrid map = test::AsciiMap({".."}).map;
  const ClassLengths lengths = lengthsByClass(pathThrough({{-1.0, 0.5}, {3.0, 0.5}}), map, {});
  EXPECT_NEAR(lengths.free_m, 2.0, 1e-12);
  EXPECT_EQ(lengths.unknown_m + lengths.occupied_m, 0.0);
}

TEST(Crossing, TheClassesSumUpToTheLength) {
  std::mt19937 random(3);
  const OccupancyGrid map = test::AsciiMap({"..#.?.#.", ".?#.#..?", "#..?..#.", "??#....#"}).map;
  std::uniform_real_distribution<double> x(0.0, 8.0), y(0.0, 4.0);
  for (int round = 0; round < 500; ++round) {
    const Path path =
        pathThrough({{x(random), y(random)}, {x(random), y(random)}, {x(random), y(random)}});
    const ClassLengths lengths = lengthsByClass(path, map, {});
    EXPECT_NEAR(lengths.free_m + lengths.unknown_m + lengths.occupied_m, lengthOf(path), 1e-9);
  }
}

}  // namespace
}  // namespace grid_path_planner::path
