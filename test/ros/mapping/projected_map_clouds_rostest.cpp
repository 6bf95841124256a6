// Clouds as they come from the field: none of them loses anything but itself.
#include <gtest/gtest.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/Empty.h>

#include <cmath>
#include <limits>

#include "ros/input/input_rules.h"
#include "ros/mapping/mapping_services.h"
#include "ros/support/mapping_fixture.h"
#include "support/bounded_run.h"

namespace grid_path_planner::nodes {
namespace {

using test::cloudOf;
using test::CloudPoints;
using test::wallAt;

class HostileClouds : public test::MappingTest {
 protected:
  void start(std::vector<std::string> arguments = {}) {
    arguments.insert(arguments.begin(), {"_tf_timeout:=0.3", "_queue_size:=50"});
    startMapping(arguments);
  }
  // Whether a good cloud that comes now is still mapped.
  bool stillMaps() {
    const Maps maps(nh_, "projected_map");
    publish(wallAt(1.0F));
    return becomes(maps, 1.05, 0.05, 100);
  }
  bool drops(const std::string& reason, const std::string& count) {
    return reports("dropped: " + reason, count);
  }
};

TEST_F(HostileClouds, AnUnknownFrameHoldsUpNoOther) {
  start();
  for (int i = 0; i < 30; ++i)
    clouds_.publish(cloudOf(wallAt(2.0F), "no_such_frame", ros::Time::now()));
  EXPECT_TRUE(stillMaps());
  EXPECT_TRUE(node_->says("no_such_frame"));
  EXPECT_TRUE(reports("dropped", "30"));
  clouds_.publish(cloudOf(wallAt(2.0F), "", ros::Time::now()));
  EXPECT_TRUE(drops("no frame", "1"));
}

// By the code: it was laid by the newest pose of its sensor, wherever that was when it measured.
TEST_F(HostileClouds, ACloudWithoutAStampIsDropped) {
  start();
  placeSensor(0.0, 0.0, 0.0);
  for (const char* frame : {"map", "sensor"})
    clouds_.publish(cloudOf(wallAt(2.0F), frame, ros::Time()));
  EXPECT_TRUE(drops("no stamp", "2"));
  EXPECT_TRUE(stillMaps());
}

// A camera with a clock of its own, and a bag that is played without use_sim_time: clouds in the map's frame were mapped,
// others waited for tf in vain, and nothing said that it was their stamps.
TEST_F(HostileClouds, ACloudOfAnotherClockIsDroppedWithTheDifference) {
  start();
  for (const double off : {-3600.0, 3600.0})
    clouds_.publish(cloudOf(wallAt(2.0F), "map", ros::Time::now() + ros::Duration(off)));
  EXPECT_TRUE(drops("too old", "1"));
  EXPECT_TRUE(drops("ahead of ROS time", "1"));
  EXPECT_TRUE(node_->says("it is 3600."));
  EXPECT_TRUE(node_->says("use_sim_time"));
  EXPECT_TRUE(stillMaps());
}

// They were bounded by number alone: queue_size clouds of any size waited for a transform.
TEST_F(HostileClouds, CloudsThatWaitAreBoundedInBytes) {
  startMapping({"_tf_timeout:=100", "_queue_size:=100"});
  sensor_msgs::PointCloud2 cloud =
      cloudOf(CloudPoints(3500000, {2.0F, 0.0F, 0.0F}), "no_such_frame", ros::Time::now());
  constexpr std::size_t kClouds = 16;  // 900 MB
  for (std::size_t i = 1; i <= kClouds; ++i) {
    cloud.header.stamp = ros::Time::now();  // one of 10 s ago is refused for that
    clouds_.publish(cloud);
    ASSERT_TRUE(reports("received", std::to_string(i)));
  }
  const std::size_t wait = rulesOf("projected_map", "cloud_in").most_bytes / cloud.data.size();
  EXPECT_TRUE(reports("waiting", std::to_string(wait)));
  EXPECT_TRUE(drops("too many bytes waiting", std::to_string(kClouds - wait)));
  if (!test::hasShadowMemory()) {
    EXPECT_LT(node_->peakMemory(), std::size_t{600} << 20);
  }
  placeSensor(0.0, 0.0, 0.0);
  EXPECT_TRUE(stillMaps());
}

TEST_F(HostileClouds, ACloudWaitsForTheTransformOfItsStamp) {
  startMapping({"_tf_timeout:=10"});
  const Maps maps(nh_, "projected_map");
  const ros::Time first = ros::Time::now();
  const ros::Time second = first + ros::Duration(0.1);
  clouds_.publish(cloudOf(wallAt(2.0F), "sensor", second));  // out of order in time
  clouds_.publish(cloudOf(wallAt(2.0F), "sensor", first));
  ASSERT_TRUE(reports("waiting", "2"));
  placeSensor(0.0, 0.0, 0.0, "sensor", first);
  ASSERT_TRUE(becomes(maps, 2.05, 0.05, 100));
  EXPECT_FALSE(test::valueAt(maps.all().back(), 5.05, 0.05) == 100);
  placeSensor(3.0, 0.0, 0.0, "sensor", second);
  EXPECT_TRUE(becomes(maps, 5.05, 0.05, 100));
  EXPECT_TRUE(reports("inserted", "2"));
}

TEST_F(HostileClouds, NaNsZeroPointsAndOrganisedCloudsWithPaddedRows) {
  start();
  const Maps maps(nh_, "projected_map");
  publish({});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  publish({{nan, 0.0F, 0.0F}, {1.0F, nan, 1.0F}, {INFINITY, 0.0F, 0.0F}});
  sensor_msgs::PointCloud2 organised = cloudOf(wallAt(2.0F), "map", ros::Time::now());
  organised.height = 20;
  organised.width /= 20;
  const std::size_t row = organised.width * organised.point_step;
  organised.row_step = static_cast<std::uint32_t>(row + 10);
  std::vector<std::uint8_t> padded;
  for (std::size_t i = 0; i < organised.height; ++i) {
    padded.insert(padded.end(), organised.data.begin() + static_cast<std::ptrdiff_t>(i * row),
                  organised.data.begin() + static_cast<std::ptrdiff_t>((i + 1) * row));
    padded.insert(padded.end(), 10, 0xff);
  }
  organised.data = padded;
  clouds_.publish(organised);
  EXPECT_TRUE(becomes(maps, 2.05, 0.05, 100));
  EXPECT_TRUE(reports("inserted", "3"));
  EXPECT_TRUE(reports("dropped", "0"));
}

TEST_F(HostileClouds, CloudsThatCannotBeReadAreRefusedWithASentence) {
  start();
  const sensor_msgs::PointCloud2 good = cloudOf(wallAt(2.0F), "map", ros::Time::now());
  sensor_msgs::PointCloud2 bad = good;
  bad.fields[0].datatype = sensor_msgs::PointField::INT16;
  clouds_.publish(bad);
  EXPECT_TRUE(node_->says("must be FLOAT32"));
  bad = good;
  bad.fields[2].name = "w";
  clouds_.publish(bad);
  bad = good;
  bad.data.resize(100);
  clouds_.publish(bad);
  bad = good;
  bad.point_step = 0;
  clouds_.publish(bad);
  EXPECT_TRUE(drops("cannot be used", "4"));
  publish({{1e30F, 0.0F, 0.0F}});
  clouds_.publish(cloudOf(wallAt(2.0F), "far", ros::Time::now()));
  placeSensor(1e9, 0.0, 0.0, "far", good.header.stamp);
  EXPECT_TRUE(stillMaps());
}

TEST_F(HostileClouds, AMillionPoints) {
  start();
  const Maps maps(nh_, "projected_map");
  CloudPoints points;
  while (points.size() < 1000000)
    for (const Eigen::Vector3f& point : wallAt(2.0F)) points.push_back(point);
  points.resize(1000000);
  publish(points);
  EXPECT_TRUE(becomes(maps, 2.05, 0.05, 100));
  EXPECT_TRUE(stillMaps());
}

// octomap_mapping#89: the ground filter flooded the log.
TEST_F(HostileClouds, OM89TheGroundFilterSaysOnceThatItFoundNoGround) {
  start({"_filter_ground:=true", "_base_frame_id:=map"});
  for (int i = 0; i < 20; ++i) publish(wallAt(2.0F));
  ASSERT_TRUE(reports("inserted", "20"));
  const std::string sentence = "No ground plane found";
  ASSERT_TRUE(node_->says(sentence));
  const std::string output = node_->output();
  EXPECT_EQ(output.find(sentence, output.find(sentence) + 1), std::string::npos);
}

TEST_F(HostileClouds, WithoutTheBaseFrameCloudsToFilterAreDroppedAndItIsSaid) {
  start({"_filter_ground:=true"});
  publish(wallAt(2.0F));
  EXPECT_TRUE(drops("no transform", "1"));
  EXPECT_TRUE(node_->says("base_footprint"));
}

// A bag that loops, as it is looked at again and again.
TEST_F(HostileClouds, TimeThatJumpsBackClearsWhatWaitsAndKeepsTheMap) {
  ros::param::set("/use_sim_time", true);
  ros::Publisher clock = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  const auto tick = [&](double seconds) {
    rosgraph_msgs::Clock message;
    message.clock = ros::Time(seconds);
    clock.publish(message);
  };
  startMapping({"_tf_timeout:=100"});
  ASSERT_TRUE(test::waitFor([&] { return clock.getNumSubscribers() > 0; }));
  tick(1000.0);
  {
    const Maps maps(nh_, "projected_map");
    clouds_.publish(cloudOf(wallAt(2.0F), "map", ros::Time(1000.0)));
    ASSERT_TRUE(test::waitFor([&] {
      tick(1000.1);
      return becomes(maps, 2.05, 0.05, 100);
    }));
    clouds_.publish(cloudOf(wallAt(2.0F), "sensor", ros::Time(1000.1)));
    ASSERT_TRUE(reports("waiting", "1"));
    tick(500.0);
    EXPECT_TRUE(drops("ROS time went back", "1"));
    placeSensor(0.0, 0.0, 0.0, "sensor", ros::Time(500.0));
    clouds_.publish(cloudOf(wallAt(1.0F, -0.45F, 0.0F), "sensor", ros::Time(500.0)));
    EXPECT_TRUE(becomes(maps, 1.05, 0.05, 100)) << "the new time is mapped";
    EXPECT_EQ(test::valueAt(maps.all().back(), 2.05, 0.05), 100) << "the old map is still there";
  }
  node_.reset();
  ros::param::del("/use_sim_time");
}

// What had been seen before ~reset and ~clear_bbx came back by itself, once its transform was there.
TEST_F(HostileClouds, WhatWaitsIsNotMappedAfterTheMapWasResetOrABoxCleared) {
  startMapping({"_tf_timeout:=100"});
  const Maps maps(nh_, "projected_map");
  const auto sees = [&](const ros::Time& stamp, const std::string& waiting) {
    clouds_.publish(cloudOf(wallAt(2.0F), "sensor", stamp));
    return reports("waiting", waiting);
  };
  const ros::Time first = ros::Time::now(), second = first + ros::Duration(0.1);
  ASSERT_TRUE(sees(first, "1"));
  std_srvs::Empty reset;
  ASSERT_TRUE(ros::service::call("/projected_map/reset", reset));
  EXPECT_TRUE(drops("came before ~reset", "1"));
  ASSERT_TRUE(sees(second, "1"));
  ClearBoxService clear;
  clear.request.min.x = 1.0;
  ASSERT_FALSE(ros::service::call("/projected_map/clear_bbx", clear)) << "that is no box";
  EXPECT_TRUE(reports("waiting", "1"));
  clear.request.max.x = 3.0;
  ASSERT_TRUE(ros::service::call("/projected_map/clear_bbx", clear));
  EXPECT_TRUE(drops("came before ~clear_bbx", "1"));
  placeSensor(0.0, 0.0, 0.0, "sensor", first);
  placeSensor(0.0, 0.0, 0.0, "sensor", second);
  publish(wallAt(1.0F));
  ASSERT_TRUE(becomes(maps, 1.05, 0.05, 100));
  EXPECT_NE(test::valueAt(maps.all().back(), 2.05, 0.05), 100);
}

// Clouds that were ready were mapped after the box was cleared.
TEST_F(HostileClouds, WhatIsReadyIsMappedBeforeABoxIsCleared) {
  startMapping({"_tf_timeout:=100", "_queue_size:=20"});
  const Maps maps(nh_, "projected_map");
  CloudPoints points;
  while (points.size() < 300000)
    for (const Eigen::Vector3f& point : wallAt(2.0F)) points.push_back(point);
  for (int i = 0; i < 20; ++i) publish(points);
  ASSERT_TRUE(reports("received", "20"));
  ClearBoxService clear;
  for (double geometry_msgs::Point::*axis :
       {&geometry_msgs::Point::x, &geometry_msgs::Point::y, &geometry_msgs::Point::z}) {
    clear.request.min.*axis = -5.0;
    clear.request.max.*axis = 5.0;
  }
  ASSERT_TRUE(ros::service::call("/projected_map/clear_bbx", clear));
  ASSERT_TRUE(reports("inserted", "20"));
  publish(wallAt(1.0F));
  ASSERT_TRUE(becomes(maps, 1.05, 0.05, 100));
  EXPECT_NE(test::valueAt(maps.all().back(), 2.05, 0.05), 100);
}

// From 2038 on, or by a clock that is wrong: differences of stamps beyond 2^31 s threw, and the
// node ended.
TEST_F(HostileClouds, StampsFromAnyTimeEndNothing) {
  start({"_decay_time:=100"});
  placeSensor(0.0, 0.0, 0.0);
  const std::uint32_t now = ros::Time::now().sec;
  const std::uint32_t half = std::uint32_t{1} << 31;
  for (const std::uint32_t stamp : {0u, 1u, now - half, now + half, 4294967295u})
    for (const char* frame : {"map", "sensor"})
      clouds_.publish(cloudOf(wallAt(1.0F), frame, ros::Time(stamp, 999999999)));
  ASSERT_TRUE(reports("received", "10"));
  EXPECT_TRUE(reports("waiting", "0"));
  EXPECT_TRUE(stillMaps());
}

// A header of a few bytes that promises 4,294,967,295 rows stood the mapping still for 18 s.
TEST_F(HostileClouds, RowsWithoutPointsTakeNoTime) {
  start();
  sensor_msgs::PointCloud2 cloud = cloudOf({}, "map", ros::Time::now());
  cloud.width = 0;
  cloud.height = std::numeric_limits<std::uint32_t>::max();
  for (int i = 0; i < 9; ++i) clouds_.publish(cloud);
  EXPECT_TRUE(stillMaps());
}

}  // namespace
}  // namespace grid_path_planner::nodes
