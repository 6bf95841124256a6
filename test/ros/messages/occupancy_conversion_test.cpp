#include "grid_path_planner/ros/occupancy_conversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "support/ascii_map.h"
#include "support/error_text.h"

namespace grid_path_planner::nodes {

using grid::GridGeometry;
using grid::OccupancyGrid;
using grid::Origin;

namespace {

using test::AsciiMap;
using test::contains;
using test::errorText;

nav_msgs::OccupancyGrid goodMessage() {
  return occupancyToMessage(AsciiMap({"..#", "?.."}, 0.05, {-1.5, 2.0, 0.0}).map, "map",
                            ros::Time(12, 34));
}

// What is said of a good message after `spoil`.
std::string errorOf(const std::function<void(nav_msgs::OccupancyGrid&)>& spoil) {
  nav_msgs::OccupancyGrid message = goodMessage();
  spoil(message);
  return errorText([&message] { occupancyFromMessage(message); });
}

TEST(OccupancyConversion, RowZeroComesFirst) {
  const nav_msgs::OccupancyGrid message = goodMessage();
  EXPECT_EQ(message.info.width, 3u);
  EXPECT_EQ(message.info.height, 2u);
  EXPECT_EQ(message.data, (std::vector<std::int8_t>{0, 0, 100, -1, 0, 0}));
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp, ros::Time(12, 34));
  EXPECT_EQ(message.info.map_load_time, ros::Time(12, 34));
  EXPECT_EQ(message.info.origin.orientation.w, 1.0);
}

// navigation2#2186, navigation#7: "/map" is "map".
TEST(OccupancyConversion, LeadingSlashIsDropped) {
  EXPECT_EQ(frameName("/map"), "map");
  EXPECT_EQ(frameName("robot/map"), "robot/map");
  EXPECT_EQ(frameName(""), "");
}

TEST(OccupancyConversionLaw, ThereAndBackIsTheIdentity) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> side(1, 30), occupancy(-1, 100), millimetres(1, 3000);
  std::uniform_real_distribution<double> place(-1000.0, 1000.0), angle(-M_PI, M_PI);
  for (int trial = 0; trial < 200; ++trial) {
    const int width = side(random), height = side(random);
    const double resolution = millimetres(random) / 1000.0;
    const Origin origin{place(random), place(random), angle(random)};
    OccupancyGrid map(GridGeometry(width, height, resolution, origin));
    for (std::int8_t& value : map.values()) value = static_cast<std::int8_t>(occupancy(random));
    const OccupancyGrid back = occupancyFromMessage(occupancyToMessage(map, "map", ros::Time()));
    EXPECT_EQ(back.values(), map.values());
    EXPECT_EQ(back.geometry().resolution(), resolution);
    EXPECT_EQ(back.geometry().origin().x, origin.x);
    EXPECT_EQ(back.geometry().origin().y, origin.y);
    EXPECT_NEAR(back.geometry().origin().yaw, origin.yaw, 1e-12);
  }
}

// octomap_server leaves the orientation at zeros: its map was refused by every node.
TEST(OccupancyConversion, AnOriginWithoutAnOrientationIsYawZero) {
  nav_msgs::OccupancyGrid message = goodMessage();
  EXPECT_FALSE(hasNoOrientation(message.info));
  message.info.origin.orientation.w = 0.0;
  EXPECT_TRUE(hasNoOrientation(message.info));
  EXPECT_EQ(occupancyFromMessage(message), occupancyFromMessage(goodMessage()));
}

TEST(OccupancyConversion, AMapWithoutCellsIsKnown) {
  EXPECT_FALSE(isEmptyMap(goodMessage()));
  EXPECT_TRUE(isEmptyMap(nav_msgs::OccupancyGrid()));
  nav_msgs::OccupancyGrid lacking = goodMessage();
  lacking.data.clear();
  EXPECT_FALSE(isEmptyMap(lacking)) << "it is wrong";
}

TEST(OccupancyConversion, BadMessagesAreRefusedWithTheirValues) {
  using Message = nav_msgs::OccupancyGrid;
  EXPECT_TRUE(contains(errorOf([](Message& m) { m.info.width = m.info.height = 0; }), "0x0"));
  EXPECT_TRUE(contains(errorOf([](Message& m) { m.info.width = 0; }), "0x2"));
  EXPECT_TRUE(contains(errorOf([](Message& m) { m.info.width = 4294967295u; }), "4294967295x2"));
  EXPECT_TRUE(contains(errorOf([](Message& m) { m.data.pop_back(); }), "needs 6 values, got 5"));
  EXPECT_TRUE(contains(errorOf([](Message& m) { m.data.push_back(0); }), "needs 6 values, got 7"));
  EXPECT_TRUE(contains(errorOf([](Message& m) { m.data[4] = 101; }), "got 101 at column 1, row 1"));
  EXPECT_TRUE(contains(errorOf([](Message& m) { m.data[2] = -2; }), "got -2 at column 2, row 0"));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float resolution : {0.0f, -0.05f, nan, infinity})
    EXPECT_TRUE(contains(errorOf([=](Message& m) { m.info.resolution = resolution; }),
                         "resolution must be a positive, finite number"));
  for (const float resolution : {1e-38f, 1e38f})
    EXPECT_TRUE(contains(errorOf([=](Message& m) { m.info.resolution = resolution; }),
                         "resolution must be from 1e-6 to 1e6 m"));
  for (const double x : {static_cast<double>(nan), 1e308, -1e9})
    EXPECT_TRUE(contains(errorOf([=](Message& m) { m.info.origin.position.x = x; }),
                         "origin must be finite and within 1e8 m"));
  EXPECT_TRUE(
      contains(errorOf([](Message& m) { m.info.origin.orientation.x = 0.3; }), "must be level"));
  EXPECT_EQ(errorOf([](Message&) {}), "");
}

}  // namespace
}  // namespace grid_path_planner::nodes
