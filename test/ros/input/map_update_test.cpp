#include <gtest/gtest.h>

#include <limits>

#include "grid_path_planner/base/errors.h"
#include "ros/input/map_receiver.h"
#include "support/ascii_map.h"

namespace grid_path_planner::nodes {

using base::InputError;
using grid::OccupancyGrid;

namespace {

map_msgs::OccupancyGridUpdate updateOf(int x, int y, unsigned width, unsigned height,
                                       const std::vector<std::int8_t>& data) {
  map_msgs::OccupancyGridUpdate update;
  update.x = x;
  update.y = y;
  update.width = width;
  update.height = height;
  update.data = data;
  return update;
}

OccupancyGrid updatedMap(OccupancyGrid map, const map_msgs::OccupancyGridUpdate& update) {
  applyUpdate(update, checkedRect(map, update), map);
  return map;
}

TEST(MapUpdate, ReplacesItsCellsAndNoOthers) {
  const OccupancyGrid map = test::AsciiMap({"....", "....", "...."}).map;
  const OccupancyGrid updated = updatedMap(map, updateOf(1, 1, 2, 2, {100, -1, 0, 100}));
  EXPECT_EQ(updated, test::AsciiMap({"....", ".#?.", "..#."}).map);
}

TEST(MapUpdate, OutOfTheMapIsRefused) {
  const OccupancyGrid map = test::AsciiMap({"....", "....", "...."}).map;
  EXPECT_THROW(updatedMap(map, updateOf(3, 1, 2, 1, {0, 0})), InputError);
  EXPECT_THROW(updatedMap(map, updateOf(1, 2, 1, 2, {0, 0})), InputError);
  EXPECT_THROW(updatedMap(map, updateOf(-1, 0, 1, 1, {0})), InputError);
  const unsigned huge = std::numeric_limits<unsigned>::max();
  EXPECT_THROW(updatedMap(map, updateOf(1, 0, huge, 1, {0})), InputError);
}

TEST(MapUpdate, WrongSizesAndValuesAreRefused) {
  const OccupancyGrid map = test::AsciiMap({"....", "...."}).map;
  EXPECT_THROW(updatedMap(map, updateOf(0, 0, 2, 2, {0, 0, 0})), InputError);
  EXPECT_THROW(updatedMap(map, updateOf(0, 0, 1, 1, {101})), InputError);
  EXPECT_THROW(updatedMap(map, updateOf(0, 0, 1, 1, {-2})), InputError);
}

}  // namespace
}  // namespace grid_path_planner::nodes
