// map_layers through a real roscore: what it hears as one map, and when there is none.
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/Empty.h>

#include <fstream>
#include <limits>

#include "ros/support/layers_fixture.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using grid::Cell;
using grid::OccupancyGrid;
using test::kOpenRoom;
using test::waitFor;

class MapLayers : public test::LayersTest {};

TEST_F(MapLayers, ALasersObstacleAppearsAndIsClearedAndOnlyWhatChangedIsSent) {
  placeLaser();
  publishStatic(kOpenRoom);
  start({"_use_scan:=true", "_source_timeout:=5", "_full_map_period:=3600"});
  EXPECT_TRUE(becomesBySeeing(5.0F, 5, 0, 100));
  const std::size_t maps = copy_.maps();
  EXPECT_TRUE(becomesBySeeing(7.0F, 5, 0, 0)) << "the ray goes through";
  EXPECT_EQ(at(7, 0), 100);
  EXPECT_EQ(copy_.maps(), maps) << "as updates";
  for (const auto& update : beats_.all()) EXPECT_LE(update.width * update.height, 12U);
}

// What was carried away while no ray crossed its place, and what dust marked, stay until somebody asks.
TEST_F(MapLayers, TheLasersObstaclesAreForgottenByClearScanAndThoseOfTheMapAreNot) {
  placeLaser();
  std::vector<std::string> room = kOpenRoom;
  room[2][8] = '#';
  publishStatic(room);
  start({"_use_scan:=true", "_source_timeout:=60"});
  EXPECT_TRUE(becomesBySeeing(5.0F, 5, 0, 100));
  ros::Publisher clear = nh_.advertise<std_msgs::Empty>("clear_scan", 1);
  ASSERT_TRUE(waitFor([&] { return clear.getNumSubscribers() > 0; }));
  clear.publish(std_msgs::Empty());
  EXPECT_TRUE(node_->says("There is no map")) << "nobody has looked since";
  EXPECT_TRUE(becomesBySeeing(std::numeric_limits<float>::quiet_NaN(), 5, 0, 0));
  EXPECT_EQ(at(8, 2), 100) << "of the static map";
  EXPECT_TRUE(becomesBySeeing(5.0F, 5, 0, 100)) << "what is still there is seen again";
}

TEST_F(MapLayers, ALiveMapWithUpdatesIsLaidOverAndItsHeartbeatGoesOn) {
  publishStatic(kOpenRoom);
  start({"_use_live_map:=true", "_source_timeout:=5"});
  EXPECT_TRUE(node_->says("There is no map")) << "it has not come yet";
  EXPECT_EQ(copy_.maps(), 0U);
  const ros::Time seen = ros::Time::now() - ros::Duration(3.0);
  live_.publish(
      occupancyToMessage(test::AsciiMap({"##", "##"}, 0.5, {4.25, 4.0, 0.0}).map, "map", seen));
  EXPECT_TRUE(becomes(4, 4, 100));
  EXPECT_EQ(at(5, 4), 100) << "a quarter of it";
  EXPECT_EQ(at(6, 4), 0);
  map_msgs::OccupancyGridUpdate update;
  update.header.frame_id = "map";
  update.header.stamp = seen + ros::Duration(1.0);
  update.width = update.height = 2;
  update.data.assign(4, 0);
  ASSERT_TRUE(waitFor([&] { return live_updates_.getNumSubscribers() > 0; }));
  live_updates_.publish(update);
  EXPECT_TRUE(becomes(4, 4, 0));
  const auto beat = beats_.waitFor(beats_.count(), [](const auto& u) { return u.width == 0; });
  ASSERT_TRUE(beat);
  EXPECT_EQ(beat->header.stamp, update.header.stamp) << "up to when the map holds what was seen";
}

TEST_F(MapLayers, WhileTheLaserIsSilentThereIsNoMapAndNoHeartbeat) {
  placeLaser();
  publishStatic(kOpenRoom);
  start({"_use_scan:=true", "_source_timeout:=0.5"});
  EXPECT_TRUE(becomesBySeeing(5.0F, 5, 0, 100));
  const std::size_t said = node_->output().size();
  EXPECT_TRUE(waitFor([&] {
    const std::string output = node_->output();
    return output.find("/scan has been silent for longer than 0.5 s", said) != std::string::npos;
  }));
  const std::size_t before = beats();
  const test::MapCopy late(nh_, "projected_map");
  ros::WallDuration(1.5).sleep();  // in which a heartbeat would come, and a latched map
  EXPECT_EQ(beats(), before);
  EXPECT_TRUE(waitFor([&] {
    see(5.0F);
    return beats() > before;
  }));
}

// As when a bag begins anew: the obstacles were forgotten, and the map was published without them.
TEST_F(MapLayers, WhenTimeHasGoneBackThereIsNoMapUntilTheLaserHasLookedAgain) {
  ros::param::set("/use_sim_time", true);
  ros::Publisher clock = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  const auto tick = [&](const ros::Time& time) {
    rosgraph_msgs::Clock message;
    message.clock = time;
    clock.publish(message);
  };
  placeLaser();
  publishStatic(kOpenRoom);
  start({"_use_scan:=true", "_source_timeout:=60", "_stale_source:=drop"});
  ros::param::del("/use_sim_time");
  const auto becomesBySeeingAt = [&](const ros::Time& time) {
    return waitFor([&] {
      tick(time);
      see(5.0F, time);
      return at(5, 0) == 100;
    });
  };
  ASSERT_TRUE(becomesBySeeingAt(ros::Time(1000.0)));
  const std::size_t maps = copy_.maps(), said = node_->output().size();
  EXPECT_TRUE(waitFor([&] {
    tick(ros::Time(500.0));
    const std::size_t held = node_->output().find("vehicles stand: nothing", said);
    return held != std::string::npos &&  // one that was sent before is refused meanwhile
           node_->output().find("has come on /scan yet", held) != std::string::npos;
  }));
  const std::size_t before = beats();
  for (int i = 0; i < 15; ++i) {  // in which a heartbeat would come
    tick(ros::Time(500.0 + 0.1 * i));
    ros::WallDuration(0.1).sleep();
  }
  EXPECT_EQ(beats(), before);
  EXPECT_EQ(copy_.maps(), maps);
  EXPECT_EQ(at(5, 0), 100);
  placeLaser();  // tf has been forgotten, too
  EXPECT_TRUE(waitFor([&] {
    tick(ros::Time(502.0));
    see(5.0F, ros::Time(502.0));
    return beats() > before;
  }));
}

// Scans that came before the static map, or one of another geometry, are in no grid of it: the map went out without the
// laser's obstacles.
TEST_F(MapLayers, AScanFromBeforeTheStaticMapDoesNotCountAsLookedAt) {
  placeLaser();
  start({"_use_scan:=true", "_source_timeout:=60", "_stale_source:=drop"});
  ASSERT_TRUE(waitFor([&] { return scans_.getNumSubscribers() > 0; }));
  for (int i = 0; i < 5; ++i) {
    see(5.0F);
    ros::WallDuration(0.1).sleep();
  }
  publishStatic(kOpenRoom);
  ASSERT_TRUE(node_->says("vehicles stand: nothing has come on /scan yet"));
  EXPECT_EQ(copy_.maps(), 0U);
  ASSERT_TRUE(becomesBySeeing(5.0F, 5, 0, 100));
  ros::WallDuration(0.5).sleep();  // for the scans that were sent
  const std::size_t maps = copy_.maps();
  publishStatic({"......", "......"});
  ros::WallDuration(1.5).sleep();  // in which a map would come
  EXPECT_EQ(copy_.maps(), maps);
  EXPECT_TRUE(becomesBySeeing(4.0F, 4, 0, 100));
}

TEST_F(MapLayers, ALaserThatIsSilentCanBeDropped) {
  placeLaser();
  publishStatic(kOpenRoom);
  start({"_use_scan:=true", "_source_timeout:=0.5", "_stale_source:=drop"});
  EXPECT_TRUE(becomesBySeeing(5.0F, 5, 0, 100));
  EXPECT_TRUE(becomes(5, 0, 0)) << "without what it said";
  EXPECT_TRUE(node_->hasSaid("The map goes on without what is not there: /scan"));
  EXPECT_TRUE(becomesBySeeing(5.0F, 5, 0, 100));
}

// Each static map of another size made a laser that is gone count again for source_timeout: where such maps come more often,
// there was never a map again.
TEST_F(MapLayers, ALaserThatWasDroppedStaysSoWhileTheStaticMapGrows) {
  placeLaser();
  publishStatic(kOpenRoom);
  start({"_use_scan:=true", "_source_timeout:=1", "_stale_source:=drop"});
  EXPECT_TRUE(becomesBySeeing(5.0F, 5, 0, 100));
  ASSERT_TRUE(node_->says("The map goes on without what is not there: /scan"));
  for (std::size_t columns = 7; columns < 12; ++columns) {
    const std::size_t maps = copy_.maps();
    publishStatic({std::string(columns, '.'), std::string(columns, '.')});
    EXPECT_TRUE(waitFor([&] { return copy_.maps() > maps; })) << columns;
  }
  EXPECT_FALSE(node_->hasSaid("/scan counts again"));
}

// It was dropped at the start, before it could have come, where it was refused, and by clear_scan: the vehicle drove
// through what it had just forgotten.
TEST_F(MapLayers, OnlyALaserThatIsSilentForItsTimeIsDropped) {
  placeLaser();
  publishStatic(kOpenRoom);
  start({"_use_scan:=true", "_source_timeout:=60", "_stale_source:=drop"});
  const std::string held = "vehicles stand: nothing has come on /scan yet";
  EXPECT_TRUE(node_->says(held));
  EXPECT_EQ(copy_.maps(), 0U);
  EXPECT_TRUE(becomesBySeeing(5.0F, 5, 0, 100));
  ros::Publisher clear = nh_.advertise<std_msgs::Empty>("clear_scan", 1);
  ASSERT_TRUE(waitFor([&] { return clear.getNumSubscribers() > 0; }));
  clear.publish(std_msgs::Empty());
  EXPECT_TRUE(waitFor([&] {
    const std::string output = node_->output();
    return output.find(held) != output.rfind(held);
  })) << "by clear_scan, again";
  EXPECT_FALSE(node_->hasSaid("The map goes on without"));
}

TEST_F(MapLayers, ALaserWhoseScansAreRefusedIsNotDropped) {
  publishStatic(kOpenRoom);
  start({"_use_scan:=true", "_source_timeout:=4", "_stale_source:=drop", "_tf_timeout:=0.1"});
  EXPECT_TRUE(waitFor([&] {
    see(5.0F);
    return node_->hasSaid("A message on /scan in frame 'laser'");
  })) << "tf does not know it";
  // For longer than source_timeout, which no stall of the machine is.
  for (int i = 0; i < 50; ++i) {
    see(5.0F);
    ros::WallDuration(0.1).sleep();
  }
  EXPECT_EQ(copy_.maps(), 0U);
  EXPECT_FALSE(node_->hasSaid("The map goes on without"));
}

TEST_F(MapLayers, ALiveMapThatIsRefusedIsNotDropped) {
  publishStatic(kOpenRoom);
  start({"_use_scan:=false", "_use_live_map:=true", "_source_timeout:=0.5", "_stale_source:=drop"});
  live_.publish(occupancyToMessage(test::AsciiMap(kOpenRoom).map, "elsewhere", ros::Time::now()));
  EXPECT_TRUE(node_->says("/live_map cannot be used"));
  const std::size_t maps = copy_.maps(), before = beats();
  ros::WallDuration(1.5).sleep();  // longer than source_timeout, in which a heartbeat would come
  EXPECT_EQ(copy_.maps(), maps);
  EXPECT_EQ(beats(), before);
}

TEST_F(MapLayers, ZonesAndMasksOfOtherResolutionsAreKeptOutOf) {
  const test::TemporaryFolder folder;
  const std::string zones =
      folder.write("zones.yaml",
                   "zones:\n"
                   "  - {kind: keep_out, polygon: [[2.5, 2.5], [4.5, 2.5], [4.5, 3.5]]}\n"
                   "  - {kind: slow, max_speed: 0.2, polygon: [[6, 6], [8, 6], [8, 7], [6, 7]]}\n");
  publishStatic(kOpenRoom);
  start({"--zones-file", zones, "_use_keep_out_mask:=true"});
  EXPECT_TRUE(node_->says("nothing has come on /keep_out_mask yet"));
  mask_.publish(occupancyToMessage(test::AsciiMap({"#"}, 0.5, {9.25, 9.25, 0.0}).map, "map",
                                   ros::Time::now()));
  EXPECT_TRUE(becomes(4, 3, 100));
  EXPECT_EQ(at(2, 2), 100);
  EXPECT_EQ(at(2, 3), 0);
  EXPECT_EQ(at(9, 9), 100);
  const auto limits = limits_.waitForMoreThan(0);
  ASSERT_TRUE(limits);
  const OccupancyGrid grid = occupancyFromMessage(*limits);
  EXPECT_EQ((grid[Cell{7, 6}]), 25);
  EXPECT_EQ((grid[Cell{5, 6}]), 0);
}

// It was refused, and no tool could turn it: whoever had surveyed such a map had no zones.
TEST_F(MapLayers, AMapWithAYawIsLaidOnAGridWithoutOne) {
  std::vector<std::string> room = kOpenRoom;
  room[5][6] = '#';
  publishStatic(room, {0.0, 0.0, 0.3});
  start({"_use_scan:=false"});
  EXPECT_TRUE(node_->says("is turned by 0.3 rad: it is laid on a grid without a yaw"));
  ASSERT_TRUE(waitFor([&] { return copy_.maps() > 0; }));
  const OccupancyGrid merged = copy_.grid();
  EXPECT_EQ(merged.geometry().origin().yaw, 0.0);
  const grid::GridGeometry turned(12, 12, 1.0, {0.0, 0.0, 0.3});
  const auto there = merged.geometry().cellAt(turned.centre({6, 5}));
  ASSERT_TRUE(there);
  EXPECT_EQ(merged[*there], 100);
}

// It held the map: publishers of maps forget the frame more often than anything else.
TEST_F(MapLayers, AMapWithoutAFrameIsInTheMapFrame) {
  start({"_use_scan:=false"});
  publishStatic(kOpenRoom, {}, "");
  EXPECT_TRUE(becomes(3, 3, 0));
}

TEST_F(MapLayers, WhatCannotBeMergedIsToldAndHoldsTheMap) {
  start({"_use_scan:=false"});
  publishStatic(kOpenRoom, {}, "odom");
  EXPECT_TRUE(node_->says("it is in frame 'odom', map_frame is 'map'"));
  EXPECT_EQ(copy_.maps(), 0U);
  publishStatic(kOpenRoom);
  EXPECT_TRUE(becomes(3, 3, 0));
}

}  // namespace
}  // namespace grid_path_planner::nodes
