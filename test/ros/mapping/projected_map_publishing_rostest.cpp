// What projected_map sends, to whom, how often and at which cost.
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <gtest/gtest.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <random>

#include "ros/support/map_listeners.h"
#include "ros/support/mapping_fixture.h"

namespace grid_path_planner::nodes {
namespace {

using test::cloudOf;
using test::CloudPoints;
using test::valueAt;
using test::wallAt;
using Updates = test::Latest<map_msgs::OccupancyGridUpdate>;

// For bursts: a node that is kept waiting drops clouds that are behind a short one.
const std::string kLongQueue = "_queue_size:=1000";

class Publishing : public test::MappingTest {
 protected:
  // A map on topic `topic` as a process of its own hears it: rostopic's text of one message.
  static std::string heardElsewhere(const std::string& topic) {
    test::Process echo({"rostopic", "echo", "-n1", topic});
    EXPECT_TRUE(echo.waitForExit());
    return echo.output();
  }
  template <class Accept>
  static bool beats(const Updates& updates, Accept accept) {
    return updates
        .waitFor(0,
                 [&](const map_msgs::OccupancyGridUpdate& update) {
                   return update.width == 0 && accept(update.header.stamp);
                 })
        .has_value();
  }
  static bool says(const diagnostic_msgs::DiagnosticArray& array, const std::string& about,
                   int level, const std::string& text) {
    return std::any_of(array.status.begin(), array.status.end(), [&](const auto& status) {
      return status.name == "projected_map: " + about && status.level == level &&
             status.message.find(text) != std::string::npos;
    });
  }
  bool warns(const std::string& about, const std::string& text) const {
    return diagnostics_
        .waitFor(0,
                 [&](const diagnostic_msgs::DiagnosticArray& array) {
                   return says(array, about, diagnostic_msgs::DiagnosticStatus::WARN, text);
                 })
        .has_value();
  }
  bool insertsAll(int count) { return reports("inserted", std::to_string(count)); }
  static std::string configured(const std::string& name, const std::string& value) {
    dynamic_reconfigure::Reconfigure call;
    dynamic_reconfigure::ConfigTools::appendParameter(call.request.config, name, value);
    EXPECT_TRUE(ros::service::call("/projected_map/set_parameters", call));
    std::string answer;
    dynamic_reconfigure::ConfigTools::getParameter(call.response.config, name, answer);
    return answer;
  }

  const std::vector<std::string> bounds_ = {
      "_projection_bounds/min_x:=-5", "_projection_bounds/min_y:=-5", "_projection_bounds/max_x:=5",
      "_projection_bounds/max_y:=5"};
};

// With clouds of a depth camera and no parameter all of the room was an obstacle, and so every goal
// occupied: an hour was lost on radii.
TEST_F(Publishing, WarnsWhereTheFloorIsAnObstacle) {
  test::CloudPoints floor;
  for (int x = 0; x < 60; ++x)
    for (int y = -30; y < 30; ++y) floor.emplace_back(0.5F + 0.1F * x, 0.1F * y, -1.0F);
  const std::string warning = "is the floor mapped as an obstacle?";
  for (const bool band : {true, false}) {
    startMapping(band ? std::vector<std::string>{"_projection_min_z:=-0.5"}
                      : std::vector<std::string>{});
    const Maps maps(nh_, "projected_map");
    ASSERT_TRUE(maps.waitForMoreThan(0));
    publish(floor);
    ASSERT_TRUE(insertsAll(1));
    ASSERT_TRUE(maps.waitFor(0, [](const nav_msgs::OccupancyGrid& map) {
      return std::count(map.data.begin(), map.data.end(), -1) + 400 <
             static_cast<std::ptrdiff_t>(map.data.size());
    }));
    if (band) {
      EXPECT_EQ(node_->output().find(warning), std::string::npos);
    } else {
      EXPECT_TRUE(node_->says(warning));
    }
  }
}

// octomap_mapping#75, PR#53: publishing took longer and longer.
TEST_F(Publishing, OM75AChangeSendsItsRectangleOnly) {
  std::vector<std::string> arguments = bounds_;
  arguments.push_back("_always_send_full_map:=false");
  startMapping(arguments);
  const Maps maps(nh_, "projected_map");
  const Updates updates(nh_, "projected_map_updates");
  ASSERT_TRUE(maps.waitForMoreThan(0));
  ASSERT_TRUE(test::waitFor([&] { return updates.connected(); }));
  publish(wallAt(2.0F));
  const auto update = updates.waitForMoreThan(0);
  ASSERT_TRUE(update);
  EXPECT_EQ(update->header.frame_id, "map");
  EXPECT_LT(update->width * update->height, 2500u);
  EXPECT_EQ(update->data.size(), update->width * update->height);
  const auto column = static_cast<std::uint32_t>(70 - update->x);
  const auto row = static_cast<std::uint32_t>(50 - update->y);
  ASSERT_LT(column, update->width);
  ASSERT_LT(row, update->height);
  EXPECT_EQ(update->data[row * update->width + column], 100);
  for (const auto& map : maps.all()) EXPECT_NE(valueAt(map, 2.05, 0.05), 100) << "no whole map";
}

// A driver could not tell a mapping that hangs, or is gone, from a map that does not change.
TEST_F(Publishing, AHeartbeatTellsUpToWhenTheMapHoldsWhatWasSeen) {
  std::vector<std::string> arguments = bounds_;
  arguments.insert(arguments.end(), {"_always_send_full_map:=false", "_heartbeat_period:=0.05"});
  startMapping(arguments);
  const Updates updates(nh_, "projected_map_updates");
  const auto heartbeat = updates.waitForMoreThan(2);
  ASSERT_TRUE(heartbeat) << "also before the first cloud";
  EXPECT_EQ(heartbeat->width + heartbeat->height + heartbeat->data.size(), 0u);
  EXPECT_EQ(heartbeat->header.frame_id, "map");
  EXPECT_TRUE(heartbeat->header.stamp.isZero());
  sensor_msgs::PointCloud2 cloud =
      cloudOf(wallAt(2.0F), "map", ros::Time::now() - ros::Duration(5.0));
  clouds_.publish(cloud);
  EXPECT_TRUE(beats(updates, [&](const ros::Time& stamp) { return stamp == cloud.header.stamp; }));
  const ros::Time before = ros::Time::now();
  cloud.header.stamp = before + ros::Duration(5.0);
  clouds_.publish(cloud);
  EXPECT_TRUE(beats(updates, [&](const ros::Time& stamp) { return stamp >= before; }));
  for (const auto& update : updates.all()) EXPECT_LE(update.header.stamp, ros::Time::now());
}

// They were stamped when they were sent: whoever handed the map on could not tell that its camera had ceased.
TEST_F(Publishing, MapsAndUpdatesAreStampedWithTheNewestCloudInThem) {
  std::vector<std::string> arguments = bounds_;
  arguments.insert(arguments.end(), {"_heartbeat_period:=0.05", "_full_map_period:=3600"});
  startMapping(arguments);
  const ros::Time seen = ros::Time::now() - ros::Duration(5.0);
  clouds_.publish(cloudOf(wallAt(2.0F), "map", seen));
  ASSERT_TRUE(insertsAll(1));
  const Maps maps(nh_, "projected_map");
  const Updates updates(nh_, "projected_map_updates");
  ASSERT_TRUE(becomes(maps, 2.05, 0.05, 100));
  EXPECT_EQ(maps.all().front().header.stamp, seen);
  ASSERT_TRUE(beats(updates, [&](const ros::Time& stamp) { return stamp == seen; }));
  const ros::Time again = seen + ros::Duration(1.0);
  clouds_.publish(cloudOf(wallAt(2.0F), "map", again));
  EXPECT_TRUE(beats(updates, [&](const ros::Time& stamp) { return stamp == again; }))
      << "a scene that does not change is seen all the same";
  // Clouds that are older add nothing newer; what is sent last has the latest stamp all the same.
  ros::Time before;
  for (const float wall : {3.0F, 4.0F}) {
    const std::size_t sent = updates.count();
    clouds_.publish(cloudOf(wallAt(wall), "map", seen));
    const auto update = updates.waitFor(sent, [](const auto& each) { return each.width > 0; });
    ASSERT_TRUE(update);
    EXPECT_GT(update->header.stamp, before);
    EXPECT_GE(update->header.stamp, again);
    EXPECT_LT((update->header.stamp - again).toSec(), 1e-3);
    before = update->header.stamp;
  }
}

TEST_F(Publishing, EveryNewSubscriberGetsAFreshWholeMap) {
  std::vector<std::string> arguments = bounds_;
  arguments.push_back("_always_send_full_map:=false");
  startMapping(arguments);
  const Maps maps(nh_, "projected_map");
  const Updates updates(nh_, "projected_map_updates");
  ASSERT_TRUE(maps.waitForMoreThan(0));
  ASSERT_TRUE(test::waitFor([&] { return updates.connected(); }));
  publish(wallAt(2.0F));
  ASSERT_TRUE(updates.waitForMoreThan(0));
  const std::size_t before = maps.count();
  heardElsewhere("/projected_map");
  const auto fresh = maps.waitForMoreThan(before);
  ASSERT_TRUE(fresh);
  EXPECT_EQ(valueAt(*fresh, 2.05, 0.05), 100);
}

TEST_F(Publishing, AWholeMapFollowsUpdatesForWhoLostOne) {
  std::vector<std::string> arguments = bounds_;
  arguments.insert(arguments.end(), {"_always_send_full_map:=false", "_full_map_period:=0.3"});
  startMapping(arguments);
  const Maps maps(nh_, "projected_map");
  const Updates updates(nh_, "projected_map_updates");
  ASSERT_TRUE(maps.waitForMoreThan(0));
  ASSERT_TRUE(test::waitFor([&] { return updates.connected(); }));
  publish(wallAt(2.0F));
  ASSERT_TRUE(updates.waitForMoreThan(0));
  EXPECT_TRUE(becomes(maps, 2.05, 0.05, 100));
}

TEST_F(Publishing, EveryChangeSendsTheWholeMapWhereThatIsAsked) {
  std::vector<std::string> arguments = bounds_;
  arguments.push_back("_always_send_full_map:=true");
  startMapping(arguments);
  const Maps maps(nh_, "projected_map");
  const Updates updates(nh_, "projected_map_updates");
  ASSERT_TRUE(maps.waitForMoreThan(0));
  publish(wallAt(2.0F));
  EXPECT_TRUE(becomes(maps, 2.05, 0.05, 100));
  EXPECT_EQ(updates.count(), 0u);
}

// octomap_server's users, who know of no updates, have every change by default too.
TEST_F(Publishing, WhoTakesUpdatesAndWhoDoesNotHaveTheSameMap) {
  std::vector<std::string> arguments = bounds_;
  arguments.push_back(kLongQueue);
  startMapping(arguments);
  const test::MapCopy both(nh_, "projected_map");
  ASSERT_TRUE(test::waitFor([&] { return both.connected() && both.maps() > 0; }));
  test::WholeMapListener whole("/projected_map");
  ASSERT_TRUE(whole.hasMap());
  std::mt19937 random(1405);
  std::uniform_real_distribution<float> place(-4.5F, 4.5F);
  const auto see = [&](int walls) {
    for (int i = 0; i < walls; ++i) {
      publish(wallAt(place(random)));
      ros::Duration(0.02).sleep();
    }
  };
  see(50);
  ASSERT_TRUE(insertsAll(50));
  EXPECT_EQ(both.updates(), 0u) << "whole maps serve both";
  whole.end();
  see(50);
  ASSERT_TRUE(insertsAll(100));
  EXPECT_TRUE(test::waitFor([&] { return both.updates() > 0; }));
  test::WholeMapListener late("/projected_map");
  ASSERT_TRUE(late.hasMap());
  EXPECT_TRUE(test::waitFor([&] { return late.grid() == both.grid(); }));
}

// octomap_server2#26: the grid does not grow with the tree.
TEST_F(Publishing, OS26ChangedGeometryIsAWholeMapAndNothingShifts) {
  startMapping({"_always_send_full_map:=false"});
  const Maps maps(nh_, "projected_map");
  publish(wallAt(2.0F));
  ASSERT_TRUE(becomes(maps, 2.05, 0.05, 100));
  publish(wallAt(-4.0F));
  const auto grown = maps.waitFor(
      0, [](const nav_msgs::OccupancyGrid& map) { return valueAt(map, -3.95, 0.05) == 100; });
  ASSERT_TRUE(grown);
  EXPECT_EQ(valueAt(*grown, 2.05, 0.05), 100);
  EXPECT_LT(grown->info.origin.position.x, -3.95);
}

// A ray that strays to 1600 m: no projection came any more, and diagnostics said OK.
TEST_F(Publishing, AStrayRayIsToldAndTheMapGoesOnChanging) {
  startMapping();
  const Maps maps(nh_, "projected_map");
  CloudPoints points = wallAt(2.0F);
  points.emplace_back(1600.0F, 1600.0F, 0.0F);
  points.emplace_back(-1600.0F, -1600.0F, 0.0F);
  publish(points);
  EXPECT_TRUE(becomes(maps, 2.05, 0.05, 100));
  publish(wallAt(-3.0F));
  EXPECT_TRUE(becomes(maps, -2.95, 0.05, 100));
  EXPECT_TRUE(test::waitFor([&] { return std::atof(reported("left_out_m2", "map").c_str()) > 0; }));
  EXPECT_TRUE(node_->says("projected_map leaves out"));
}

// octomap_mapping#75: what nobody wanted to see was built with every cloud.
TEST_F(Publishing, OM75NothingIsBuiltThatNobodySubscribesTo) {
  startMapping();
  for (int i = 0; i < 8; ++i) publish(wallAt(1.05F + 0.1F * static_cast<float>(i)));
  ASSERT_TRUE(insertsAll(8));
  // A report about the map as it is after the last cloud.
  const std::size_t nodes_known = diagnostics_.count();
  ASSERT_TRUE(diagnostics_.waitForMoreThan(nodes_known + 5));
  EXPECT_NE(reported("nodes", "map"), "0");
  EXPECT_EQ(reported("projections", "map"), "0");
  EXPECT_EQ(reported("tree_messages", "map"), "0");
  const Maps maps(nh_, "projected_map");
  EXPECT_TRUE(becomes(maps, 1.75, 0.05, 100)) << "it has waited in the tree";
  EXPECT_EQ(reported("tree_messages", "map"), "0");
  const test::Latest<sensor_msgs::PointCloud2> centres(nh_, "octomap_point_cloud_centers");
  EXPECT_TRUE(centres.waitForMoreThan(0));
  EXPECT_TRUE(reports("tree_messages", "1", "map"));
  const test::Latest<visualization_msgs::MarkerArray> cells(nh_, "occupied_cells_vis_array");
  EXPECT_TRUE(cells.waitForMoreThan(0));
  EXPECT_TRUE(reports("tree_messages", "2", "map"));
  EXPECT_EQ(centres.count(), 1U) << "the map has stayed as it is";
}

TEST_F(Publishing, PublicationsAreRateLimited) {
  startMapping({"_publish_rate:=1", kLongQueue});
  const Maps maps(nh_, "projected_map");
  ASSERT_TRUE(maps.waitForMoreThan(0));
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 40; ++i) {
    publish(wallAt(1.0F + 0.1F * static_cast<float>(i % 20)));
    ros::Duration(0.02).sleep();
  }
  ASSERT_TRUE(insertsAll(40));
  const double passed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_LE(static_cast<double>(maps.count()), 4.0 + passed);
}

// octomap#183, octomap_mapping#62, #110: removed objects stayed.
TEST_F(Publishing, O183WhatIsSeenThroughIsFreed) {
  startMapping();
  const Maps maps(nh_, "projected_map");
  publish(wallAt(1.0F));
  ASSERT_TRUE(becomes(maps, 1.05, 0.05, 100));
  for (int i = 0; i < 20; ++i) publish(wallAt(3.0F, -1.35F, 1.35F));
  EXPECT_TRUE(becomes(maps, 1.05, 0.05, 0));
}

TEST_F(Publishing, OM62WhatIsNotSeenAgainFades) {
  startMapping({"_decay_time:=2"});
  const Maps maps(nh_, "projected_map");
  ASSERT_TRUE(test::waitFor([&] {  // what is seen just before a step of the decay is faded at once
    publish(wallAt(1.0F));
    const auto all = maps.all();
    return !all.empty() && valueAt(all.back(), 1.05, 0.05) == 100;
  }));
  const std::size_t seen = maps.count();
  EXPECT_TRUE(maps.waitFor(seen, [](const auto& map) { return valueAt(map, 1.05, 0.05) != 100; }));
}

TEST_F(Publishing, TheBandCanBeChangedWhileItRunsAndABadOneIsRefused) {
  startMapping({"_projection_max_z:=-0.2"});
  const Maps maps(nh_, "projected_map");
  publish(wallAt(1.0F, -0.15F, 0.45F));
  const auto below =
      maps.waitFor(0, [](const nav_msgs::OccupancyGrid& map) { return map.info.width > 1; });
  ASSERT_TRUE(below);
  EXPECT_NE(valueAt(*below, 1.05, 0.05), 100);
  EXPECT_EQ(configured("projection_max_z", "high"), "-0.2");
  EXPECT_TRUE(node_->says("projection_max_z must be a height"));
  EXPECT_EQ(configured("projection_max_z", "0.3"), "0.3");
  EXPECT_TRUE(becomes(maps, 1.05, 0.05, 100));
  EXPECT_EQ(configured("frame_id", "odom"), "map");
}

TEST_F(Publishing, TheBandFollowsTheVehiclesDepth) {
  startMapping({"_projection_reference:=vehicle", "_projection_min_z:=-0.2",
                "_projection_max_z:=0.2", "_base_frame_id:=base_link"});
  const Maps maps(nh_, "projected_map");
  publish(wallAt(1.0F, -0.45F, 0.0F));
  ASSERT_TRUE(insertsAll(1));
  EXPECT_EQ(maps.count(), 0u) << "the depth is not known yet";
  placeSensor(0.0, 0.0, -0.3, "base_link");
  EXPECT_TRUE(becomes(maps, 1.05, 0.05, 100));
  placeSensor(0.0, 0.0, 2.0, "base_link", ros::Time::now() + ros::Duration(0.1));
  EXPECT_TRUE(becomes(maps, 1.05, 0.05, -1));
}

// What was seen: 30 s after tf had ceased the band was still about the depth that the vehicle had had, and heartbeats said
// that the map was kept up.
TEST_F(Publishing, NoMapIsMadeAboutADepthOfLongAgo) {
  startMapping({"_projection_reference:=vehicle", "_projection_min_z:=-0.2",
                "_projection_max_z:=0.2", "_base_frame_id:=base_link", "_heartbeat_period:=0.05"});
  const Maps maps(nh_, "projected_map");
  const Updates updates(nh_, "projected_map_updates");
  placeSensor(0.0, 0.0, -0.3, "base_link");
  publish(wallAt(1.0F, -0.45F, 0.0F));
  ASSERT_TRUE(becomes(maps, 1.05, 0.05, 100));
  ASSERT_TRUE(node_->says(" s old"));  // of the pose; at first it is not known
  const std::size_t reports = diagnostics_.count();
  ASSERT_TRUE(diagnostics_.waitForMoreThan(reports + 2));  // what was sent before is there
  const std::size_t seen = maps.count(), beats = updates.count();
  publish(wallAt(2.0F, -0.45F, 0.0F));
  ASSERT_TRUE(insertsAll(2));
  ASSERT_TRUE(diagnostics_.waitForMoreThan(diagnostics_.count() + 2));
  EXPECT_EQ(maps.count(), seen);
  EXPECT_EQ(updates.count(), beats);
  ASSERT_TRUE(test::waitFor([&] {
    placeSensor(0.0, 0.0, -0.3, "base_link");
    return maps.count() > seen && updates.count() > beats;
  })) << "and it goes on with tf";
}

// A driver went on by a map that lacked what was seen, since heartbeats said that the map was kept up.
TEST_F(Publishing, NoHeartbeatSpeaksForAMapThatIsNotSent) {
  startMapping(
      {"_projection_reference:=vehicle", "_base_frame_id:=base_link", "_heartbeat_period:=0.05"});
  const Maps maps(nh_, "projected_map");
  const Updates updates(nh_, "projected_map_updates");
  publish(wallAt(1.0F));
  ASSERT_TRUE(insertsAll(1));
  ASSERT_TRUE(warns("map", "cannot be made"));
  const std::size_t reports = diagnostics_.count();
  ASSERT_TRUE(diagnostics_.waitForMoreThan(reports + 2));  // what was sent before is there
  const std::size_t before = updates.count();
  ASSERT_TRUE(diagnostics_.waitForMoreThan(reports + 8));
  EXPECT_EQ(updates.count(), before);
  placeSensor(0.0, 0.0, 0.0, "base_link");
  EXPECT_TRUE(becomes(maps, 1.05, 0.05, 100));
  EXPECT_TRUE(updates.waitForMoreThan(before + 2));
}

// The camera had been dead for an hour, and every status was OK.
TEST_F(Publishing, ACameraThatIsSilentIsAWarning) {
  startMapping();
  publish(wallAt(1.0F));
  ASSERT_TRUE(warns("clouds", "/cloud_in has been silent for longer than 5 s"));
  publish(wallAt(1.0F));
  EXPECT_TRUE(test::waitFor([this] {
    const auto arrays = diagnostics_.all();
    return std::any_of(arrays.rbegin(), arrays.rbegin() + 3, [](const auto& array) {
      return says(array, "clouds", diagnostic_msgs::DiagnosticStatus::OK, "clouds are mapped");
    });
  }));
}

TEST_F(Publishing, VoxelsAreShownInsideOfTheOccupancyBand) {
  startMapping({"_occupancy_max_z:=0.1", "_publish_free_space:=true"});
  const test::Latest<visualization_msgs::MarkerArray> occupied(nh_, "occupied_cells_vis_array");
  const test::Latest<visualization_msgs::MarkerArray> free(nh_, "free_cells_vis_array");
  const test::Latest<sensor_msgs::PointCloud2> centres(nh_, "octomap_point_cloud_centers");
  publish(wallAt(1.0F));
  const auto cloud = centres.waitFor(0, [](const auto& cloud) { return cloud.width > 0; });
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->header.frame_id, "map");
  sensor_msgs::PointCloud2ConstIterator<float> x(*cloud, "x");
  for (; x != x.end(); ++x) {
    EXPECT_NEAR(x[0], 1.05, 1e-4);
    EXPECT_LT(x[2], 0.1);
  }
  const auto cubes = [](const visualization_msgs::MarkerArray& array) {
    std::size_t number = 0;
    for (const auto& marker : array.markers) number += marker.points.size();
    return number;
  };
  const auto shown = occupied.waitFor(0, [&](const auto& array) { return cubes(array) > 0; });
  ASSERT_TRUE(shown);
  EXPECT_EQ(cubes(*shown), cloud->width);
  EXPECT_EQ(shown->markers.back().colors.size(), shown->markers.back().points.size());
  EXPECT_TRUE(free.waitFor(0, [&](const auto& array) { return cubes(array) > 10; }));
}

}  // namespace
}  // namespace grid_path_planner::nodes
