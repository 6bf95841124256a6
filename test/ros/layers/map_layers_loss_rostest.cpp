// map_layers through a real roscore: a map that lacks what was lost, many changes at once, a scan of another clock.
#include "ros/support/layers_fixture.h"

namespace grid_path_planner::nodes {
namespace {

using test::kOpenRoom;
using test::waitFor;

class MapLayersLoss : public test::LayersTest {};

// By the code: who drives by the merged map heard nothing of it, since its own numbers had no gap, and its heartbeat went on.
TEST_F(MapLayersLoss, AMapThatLacksAnUpdateHoldsTheMapUntilAWholeOneComes) {
  auto numbered = ros::AdvertiseOptions::create<map_msgs::OccupancyGridUpdate>(
      "numbered_updates", 10, {}, {}, {}, nullptr);
  numbered.has_header = false;  // header.seq is the test's
  ros::Publisher updates = nh_.advertise(numbered);
  const auto beat = [&](std::uint32_t number) {
    map_msgs::OccupancyGridUpdate heartbeat;
    heartbeat.header.seq = number;
    heartbeat.header.stamp = ros::Time::now();
    updates.publish(heartbeat);
  };
  for (const std::string layer : {"static_map", "live_map"}) {
    const std::size_t none = beats();
    publishStatic(kOpenRoom);
    live_.publish(occupancyToMessage(test::AsciiMap(kOpenRoom).map, "map", ros::Time::now()));
    start({"_use_live_map:=true", "_source_timeout:=60", layer + "_updates:=numbered_updates"});
    ASSERT_TRUE(waitFor([&] { return beats() > none && updates.getNumSubscribers() > 0; }));
    beat(1);
    beat(4);
    EXPECT_TRUE(node_->says("There is no map, vehicles stand: /" + layer + " lacks changes"));
    ros::WallDuration(0.3).sleep();  // for one that was being sent
    const std::size_t before = beats();
    ros::WallDuration(1.5).sleep();  // in which a heartbeat would come
    EXPECT_EQ(beats(), before);
    publishStatic(kOpenRoom);
    live_.publish(occupancyToMessage(test::AsciiMap(kOpenRoom).map, "map", ros::Time::now()));
    EXPECT_TRUE(waitFor([&] { return beats() > before; }));
    node_.reset();
    ASSERT_TRUE(waitFor([&] { return updates.getNumSubscribers() == 0; }));
  }
}

// Who drives by it holds when one of the sensors has ceased, whatever the others go on saying.
TEST_F(MapLayersLoss, TheMapIsStampedWithTheOldestOfWhatItsSensorsDeliveredLast) {
  const test::Latest<nav_msgs::OccupancyGrid> maps(nh_, "projected_map");
  const auto stamped = [&](const ros::Time& stamp) {
    return test::waitFor([&] {
      const auto beats = beats_.all();
      return !beats.empty() && beats.back().width == 0 && beats.back().header.stamp == stamp;
    });
  };
  publishStatic(kOpenRoom);
  start({"_source_timeout:=60"});
  EXPECT_TRUE(stamped(ros::Time())) << "it is of a file alone";
  node_.reset();
  placeLaser();
  const ros::Time seen = ros::Time::now() - ros::Duration(5.0);
  start({"_use_live_map:=true", "_use_scan:=true", "_source_timeout:=60"});
  live_.publish(occupancyToMessage(test::AsciiMap(kOpenRoom).map, "map", seen));
  ASSERT_TRUE(becomesBySeeing(5.0F, 5, 0, 100));
  EXPECT_TRUE(stamped(seen));
  EXPECT_LT((maps.all().back().header.stamp - seen).toSec(), 1e-3);
}

// Of 256 updates in one instant, which their queue does not hold, the oldest were lost.
TEST_F(MapLayersLoss, WhatChangesInManyPlacesIsSentInFewUpdates) {
  const std::vector<std::string> large(400, std::string(400, '.'));
  publishStatic(large);
  start({"_use_scan:=false", "_full_map_period:=3600"});
  ASSERT_TRUE(waitFor([&] { return copy_.maps() > 0; }));
  std::vector<std::string> changed = large;
  for (int row = 0; row < 400; row += 40)
    for (int column = 0; column < 400; column += 40) changed[row][column] = '#';
  const std::size_t maps = copy_.maps();
  publishStatic(changed);
  EXPECT_TRUE(waitFor([&] { return copy_.grid() == test::AsciiMap(changed).map; }));
  EXPECT_EQ(copy_.maps(), maps) << "as updates";
  EXPECT_LE(beats_.count() - beats(), 50U);
}

// One of another clock took the place of all that came after it, for as long as it was ahead.
TEST_F(MapLayersLoss, AScanFromTheFutureHoldsUpNoOther) {
  placeLaser();
  publishStatic(kOpenRoom);
  start({"_use_scan:=true", "_source_timeout:=60"});
  ASSERT_TRUE(waitFor([&] { return scans_.getNumSubscribers() > 0; }));
  see(3.0F, ros::Time::now() + ros::Duration(8.0));
  ASSERT_TRUE(node_->says("ahead"));
  EXPECT_TRUE(becomesBySeeing(5.0F, 5, 0, 100));
}

}  // namespace
}  // namespace grid_path_planner::nodes
