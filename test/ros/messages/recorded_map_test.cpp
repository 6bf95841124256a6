// The recording in test/data, which a real rosbag made (see its README.md).
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>

#include "grid_path_planner/ros/bag.h"
#include "grid_path_planner/ros/occupancy_conversion.h"

namespace grid_path_planner::nodes {

using grid::Cell;
using grid::GridGeometry;
using grid::OccupancyGrid;

namespace {

constexpr const char* kBag = "test/data/projected_map.bag";

std::vector<OccupancyGrid> allMaps() {
  rosbag::Bag bag(kBag);
  std::vector<OccupancyGrid> maps;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag))
    maps.push_back(occupancyFromMessage(*instance.instantiate<nav_msgs::OccupancyGrid>()));
  return maps;
}

int countOf(const OccupancyGrid& map, std::int8_t value) {
  return static_cast<int>(std::count(map.values().begin(), map.values().end(), value));
}

TEST(RecordedMap, TheFirstMessageIsTheMap) {
  const OccupancyGrid map = readMapFromBag(kBag);
  EXPECT_EQ(map.geometry(), GridGeometry(80, 60, 0.05, {-2.0, -1.5, 0.0}));
  EXPECT_GT(countOf(map, 0), 1000);
  EXPECT_GT(countOf(map, -1), 1000);
  EXPECT_GT(countOf(map, 100), 100);
  EXPECT_EQ(map, readAnyMapFile(kBag));
  EXPECT_EQ(map, allMaps().at(0));
}

TEST(RecordedMap, LaterMapsKnowMoreHoldACrateAndGrow) {
  const std::vector<OccupancyGrid> maps = allMaps();
  ASSERT_EQ(maps.size(), 4u);
  EXPECT_LT(countOf(maps[1], -1), countOf(maps[0], -1));
  EXPECT_EQ(maps[1][(Cell{33, 13})], 0);
  EXPECT_EQ(maps[2][(Cell{33, 13})], 100);
  EXPECT_EQ(maps[3].geometry(), GridGeometry(96, 60, 0.05, {-2.8, -1.5, 0.0}));
  EXPECT_EQ(maps[3][(Cell{33 + 16, 13})], 100);
}

}  // namespace
}  // namespace grid_path_planner::nodes
