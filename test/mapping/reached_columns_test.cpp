// Whichever columns changed, however far they reach: by another hand, each column is asked for each place.
#include "mapping/reached_columns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <set>
#include <utility>

namespace grid_path_planner::mapping {
namespace {

using Place = std::pair<int, int>;

BrickColumn anywhere(std::mt19937& random, int side) {
  const int first = random() % 2 == 0 ? 0 : 8192 - side;  // at the borders, too
  const auto coordinate = [&] {
    return static_cast<std::uint16_t>(first +
                                      static_cast<int>(random() % static_cast<unsigned>(side)));
  };
  const std::uint16_t x = coordinate();
  return {x, coordinate()};
}

bool isWithin(BrickColumn one, BrickColumn other, int reach) {
  return std::abs(one.x - other.x) <= reach && std::abs(one.y - other.y) <= reach;
}

class ReachedColumnsLaw : public testing::TestWithParam<unsigned> {};

TEST_P(ReachedColumnsLaw, AreThoseOfTheMapThatLieNearAPlace) {
  std::mt19937 random(GetParam());
  const int side = 5 + static_cast<int>(random() % 120);
  OccupancyBricks bricks(0.1);
  for (int i = 0; i < 400; ++i) {
    const BrickColumn column = anywhere(random, side);
    bricks.fillBrick({column.x, column.y, 4096}, Voxel::OCCUPIED);
  }
  for (const int reach : {0, 1, 3, 40, 100000}) {
    std::vector<BrickColumn> places(1 + random() % 30);
    for (BrickColumn& place : places) place = anywhere(random, side);
    std::set<Place> reached;
    for (const BrickColumn column : reachedColumns(bricks, places, reach))
      reached.insert({column.x, column.y});
    for (const BrickColumn column : bricks.columns()) {
      const bool is_reached = std::any_of(places.begin(), places.end(), [&](BrickColumn place) {
        return isWithin(column, place, reach);
      });
      ASSERT_EQ(reached.count({column.x, column.y}), is_reached ? 1u : 0u)
          << "seed " << GetParam() << ", reach " << reach;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ReachedColumnsLaw, testing::Range(0u, 20u));

TEST(ReachedColumns, AreNoMoreThanThereAreColumns) {
  OccupancyBricks bricks(0.1);
  std::vector<BrickColumn> all;
  for (std::uint16_t x = 0; x < 50; ++x)
    for (std::uint16_t y = 0; y < 40; ++y) {
      bricks.fillBrick({x, y, 0}, Voxel::FREE);
      all.push_back({x, y});
    }
  EXPECT_EQ(reachedColumns(bricks, all, 250).size(), 2000u);
  EXPECT_LE(reachedColumns(bricks, {{20, 20}}, 3).size(), 2000u);
  EXPECT_TRUE(reachedColumns(bricks, {}, 250).empty());
}

}  // namespace
}  // namespace grid_path_planner::mapping
