#include "grid/foreign_values.h"

#include <gtest/gtest.h>

#include <random>

namespace grid_path_planner::grid {
namespace {

using Values = std::vector<std::int8_t>;

OccupancyGrid mapOf(int width, const Values& values) {
  return {GridGeometry(width, static_cast<int>(values.size()) / width, 1.0), values};
}

std::string problemOf(const Values& values, const OccupancyThresholds& thresholds = {}) {
  const auto map = std::make_shared<OccupancyGrid>(mapOf(static_cast<int>(values.size()), values));
  return ThresholdFit().problem(map, thresholds);
}

// Of cartographer: all was unknown, and paths led through its walls without a word.
TEST(ThresholdFit, GreysBetweenTheThresholdsAreTold) {
  EXPECT_EQ(problemOf({-1, 38, 57, 40, 38}),
            "no cell of the map is free (at most free_max, 25) or occupied (at least occupied_min, "
            "65): its values from 38 to 57 count as unknown");
  EXPECT_EQ(problemOf({-1, 10, 57}),
            "no cell of the map is occupied (at least occupied_min, 65): its values from 57 to 57 "
            "count as unknown");
  EXPECT_EQ(problemOf({-1, 38, 70}),
            "no cell of the map is free (at most free_max, 25): its values from 38 to 38 count as "
            "unknown");
  EXPECT_EQ(problemOf({-1, 38, 57, 40, 38}, {45, 50}), "");
}

TEST(ThresholdFit, MapsWithoutGreysAndThoseOfAllClassesFit) {
  EXPECT_EQ(problemOf({-1, -1}), "");
  EXPECT_EQ(problemOf({0, 0, -1}), "");
  EXPECT_EQ(problemOf({100, -1}), "");
  EXPECT_EQ(problemOf({0, 40, 100}), "");
}

// It remembers a free and an occupied cell, and looks no further while they are so.
TEST(ThresholdFit, LawAnswersDependOnTheMapAloneWhateverWasAskedBefore) {
  std::mt19937 random(57);
  ThresholdFit fit;
  for (int trial = 0; trial < 500; ++trial) {
    const int width = 1 + static_cast<int>(random() % 5),
              height = 1 + static_cast<int>(random() % 5);
    const Values choices = trial % 3 == 0 ? Values{-1, 38, 57} : Values{-1, 0, 38, 57, 100};
    const auto map = std::make_shared<OccupancyGrid>(GridGeometry(width, height, 1.0));
    for (std::int8_t& value : map->values()) value = choices[random() % choices.size()];
    int count[3] = {}, between = 0;
    for (const std::int8_t value : map->values()) {
      ++count[static_cast<int>(OccupancyThresholds().classify(value))];
      between += value == 38 || value == 57;
    }
    const bool fits = between == 0 || (count[static_cast<int>(Occupancy::FREE)] > 0 &&
                                       count[static_cast<int>(Occupancy::OCCUPIED)] > 0);
    const std::string problem = fit.problem(map, {});
    ASSERT_EQ(problem.empty(), fits) << trial;
    ASSERT_EQ(problem, ThresholdFit().problem(map, {})) << trial;
    ASSERT_EQ(problem, fit.problem(map, {})) << "asked again, " << trial;
    ASSERT_EQ(fit.problem(map, {45, 50}), "") << "by others, " << trial;
  }
}

TEST(ThresholdFit, AsksWhetherItShouldGoOn) {
  base::StopSource stop;
  stop.cancel();
  const auto map = std::make_shared<OccupancyGrid>(GridGeometry(1, 100, 1.0));
  EXPECT_THROW(ThresholdFit().problem(map, {}, stop.token()), base::Stopped);
}

// As costmap_2d publishes a point with an inscribed radius of a cell, and what lies around.
TEST(Inflated, CostmapsAreKnownByTheirInscribedCells) {
  EXPECT_TRUE(isInflated({60, 80, 99, 80, 60,   //
                          80, 99, 100, 99, 80,  //
                          60, 80, -1, 80, 60},
                         5));
  EXPECT_TRUE(isInflated({99, 100, 100, 0, 99, 99}, 3)) << "at the border";
  EXPECT_FALSE(isInflated({0, 100, 0}, 3)) << "map_server's";
  EXPECT_FALSE(isInflated({98, 100, 99}, 3)) << "cartographer's may have any value";
  EXPECT_FALSE(isInflated({99, 98, 100, 99}, 1)) << "above it";
  EXPECT_FALSE(isInflated({0, 99, 0}, 3));
  EXPECT_FALSE(isInflated({100, 100}, 2));
  EXPECT_FALSE(isInflated({}, 0));
}

}  // namespace
}  // namespace grid_path_planner::grid
