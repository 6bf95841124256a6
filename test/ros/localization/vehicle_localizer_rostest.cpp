#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <limits>

#include "grid_path_planner/SetPose.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "ros/support/sensor_stream.h"
#include "support/error_text.h"

namespace grid_path_planner::nodes {
namespace {

using test::contains;
using test::Latest;
using test::Process;
using test::SensorStream;
using test::waitFor;

// Sends in a thread of its own, by the wall clock.
class LiveStream {
 public:
  explicit LiveStream(SensorStream& stream) : thread_([this, &stream] { run(stream); }) {}
  ~LiveStream() {
    over_ = true;
    thread_.join();
  }
  double secondsAt(const ros::Time& stamp) const { return (stamp - start_).toSec(); }

 private:
  void run(SensorStream& stream) {
    for (int tick = 0; !over_; ++tick) {
      const ros::Time due = start_ + ros::Duration(0.01 * tick);
      while (ros::Time::now() < due) ros::WallDuration(0.001).sleep();
      stream.send(due, tick);
    }
  }
  const ros::Time start_ = ros::Time::now();
  std::atomic<bool> over_{false};
  std::thread thread_;
};

class VehicleLocalizerTest : public testing::Test {
 protected:
  void start(const std::vector<std::string>& arguments = {}) {
    ros::param::del("/vehicle_localizer");
    node_ = std::make_unique<Process>("vehicle_localizer", arguments);
    live_ = std::make_unique<LiveStream>(stream_);
  }
  bool hasStatus(const std::string& name) {
    return waitFor([&] {
      const auto all = statuses_.all();
      return !all.empty() && contains(all.back().data, name + ":");
    });
  }
  // How many transforms to `child` came from the node.
  std::size_t transformsTo(const std::string& child) const {
    std::size_t count = 0;
    for (const tf2_msgs::TFMessage& message : tf_.all())
      for (const auto& transform : message.transforms)
        count += transform.child_frame_id == child && transform.header.frame_id != "rival";
    return count;
  }
  bool moreTransformsTo(const std::string& child, std::size_t than) {
    return waitFor([&] { return transformsTo(child) > than; });
  }
  double errorOf(const nav_msgs::Odometry& odometry) const {
    const auto& p = odometry.pose.pose.position;
    return (stream_.positionAt(live_->secondsAt(odometry.header.stamp)) -
            Eigen::Vector3d(p.x, p.y, p.z))
        .norm();
  }

  ros::NodeHandle nh_;
  Latest<std_msgs::String> statuses_{nh_, "localization_status"};
  Latest<nav_msgs::Odometry> filtered_{nh_, "odometry/filtered"};
  Latest<tf2_msgs::TFMessage> tf_{nh_, "/tf"};
  SensorStream stream_{nh_};
  std::unique_ptr<Process> node_;
  std::unique_ptr<LiveStream> live_;
};

TEST_F(VehicleLocalizerTest, EstimatesThePoseAndPublishesEachStampOnce) {
  start();
  ASSERT_TRUE(hasStatus("OK"));
  const std::size_t seen = filtered_.count();
  ASSERT_TRUE(waitFor([&] { return filtered_.count() > seen + 50; }));
  EXPECT_LT(errorOf(filtered_.all().back()), 0.1);
  const auto all = filtered_.all();
  for (std::size_t i = 1; i < all.size(); ++i)
    EXPECT_LT(all[i - 1].header.stamp, all[i].header.stamp);
  EXPECT_TRUE(moreTransformsTo("odom", 0));
  EXPECT_TRUE(moreTransformsTo("base_link", 0));
  EXPECT_EQ(all.back().header.frame_id, "map");
  EXPECT_EQ(all.back().child_frame_id, "base_link");
}

TEST_F(VehicleLocalizerTest, GoesOnWithoutItsImuAndSaysSo) {
  start({"_max_angle:=60"});  // which is soon uncertain without an IMU
  ASSERT_TRUE(hasStatus("OK"));
  stream_.sends_imu = false;
  ASSERT_TRUE(hasStatus("DEGRADED"));
  EXPECT_TRUE(contains(statuses_.all().back().data, "IMU lost"));
  const std::size_t seen = filtered_.count();
  ASSERT_TRUE(waitFor([&] { return filtered_.count() > seen + 20; }));
  EXPECT_LT(errorOf(filtered_.all().back()), 1.0);
  stream_.sends_imu = true;
  EXPECT_TRUE(hasStatus("OK"));
}

// The vehicle stops where tf is old: a pose that is not known is not to be driven on.
TEST_F(VehicleLocalizerTest, NoTransformOfTheMapWhereThePoseIsLost) {
  start({"_max_deviation:=0.5"});
  ASSERT_TRUE(hasStatus("OK"));
  stream_.sends_dvl = stream_.sends_fixes = false;
  ASSERT_TRUE(hasStatus("LOST"));
  const std::size_t of_map = transformsTo("odom"), of_odom = transformsTo("base_link");
  EXPECT_TRUE(moreTransformsTo("base_link", of_odom + 20));
  EXPECT_LE(transformsTo("odom"), of_map + 1);  // one may have been sent just then
  stream_.sends_dvl = stream_.sends_fixes = true;
  EXPECT_TRUE(hasStatus("OK"));
  EXPECT_TRUE(moreTransformsTo("odom", of_map + 1));
}

// It named the body frame though it was refused, and the vehicle's own IMU was another one for ever.
TEST_F(VehicleLocalizerTest, AnImuThatIsRefusedNamesNoFrame) {
  ros::Publisher strangers = nh_.advertise<sensor_msgs::Imu>("imu/data", 1);
  tf2_ros::TransformBroadcaster broadcaster;
  ros::param::del("/vehicle_localizer");
  node_ = std::make_unique<Process>("vehicle_localizer", std::vector<std::string>{});
  sensor_msgs::Imu wrong = stream_.imu(ros::Time::now(), 0.0);
  wrong.header.frame_id = "usbl_link";
  wrong.angular_velocity.x = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(waitFor([&] {
    wrong.header.stamp = ros::Time::now();
    broadcaster.sendTransform(stream_.frames(wrong.header.stamp));
    if (strangers.getNumSubscribers() > 0) strangers.publish(wrong);
    return node_->hasSaid("the angular velocity (rad/s) must be within");
  })) << node_->output();
  live_ = std::make_unique<LiveStream>(stream_);
  EXPECT_TRUE(hasStatus("OK")) << node_->output();
}

// Its place on the vehicle would be that of the estimate itself.
TEST_F(VehicleLocalizerTest, ASensorThatTfHasInTheMapIsRefused) {
  tf2_ros::StaticTransformBroadcaster fixed;
  geometry_msgs::TransformStamped in_map;
  in_map.header.stamp = ros::Time::now();
  in_map.header.frame_id = "map";
  in_map.child_frame_id = "fixed_dvl";
  in_map.transform.rotation.w = 1.0;
  fixed.sendTransform(in_map);
  ros::Publisher others = nh_.advertise<geometry_msgs::TwistWithCovarianceStamped>("dvl/twist", 1);
  start();
  ASSERT_TRUE(hasStatus("OK"));
  EXPECT_TRUE(waitFor([&] {
    const ros::Time now = ros::Time::now();
    auto twist = stream_.dvl(now, live_->secondsAt(now));
    twist.header.frame_id = "fixed_dvl";
    others.publish(twist);
    return node_->hasSaid("tf has 'fixed_dvl' in map, not on the vehicle");
  })) << node_->output();
}

TEST_F(VehicleLocalizerTest, FixesAreShownAsTheyWereJudged) {
  using visualization_msgs::MarkerArray;
  Latest<MarkerArray> markers(nh_, "fix_markers");
  ros::Publisher strays = nh_.advertise<SensorStream::Fix>("usbl/pose", 1);
  start();
  ASSERT_TRUE(hasStatus("OK"));
  ASSERT_TRUE(waitFor([&] { return markers.connected() && strays.getNumSubscribers() > 0; }));
  const ros::Time now = ros::Time::now();
  SensorStream::Fix stray = stream_.usbl(now, live_->secondsAt(now));
  stray.pose.pose.position.x += 20.0;
  strays.publish(stray);
  const auto shown = markers.waitFor(0, [](const MarkerArray& array) {
    return array.markers[0].ns == "accepted" && array.markers[0].points.size() > 5 &&
           array.markers[1].ns == "rejected" && array.markers[1].points.size() == 1;
  });
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->markers[0].header.frame_id, "map");
  EXPECT_EQ(shown->markers[1].points[0].x, stray.pose.pose.position.x);
  std_srvs::Trigger reset;
  ASSERT_TRUE(ros::service::call("vehicle_localizer/reset", reset));
  EXPECT_TRUE(markers.waitFor(0, [](const MarkerArray& array) {
    return array.markers[1].action == visualization_msgs::Marker::DELETE &&
           array.markers[1].points.empty() && array.markers[0].points.size() < 5;
  }));
}

// The simulator, or a second localisation, publishes it already: the vehicle would jump to and fro.
TEST_F(VehicleLocalizerTest, AnotherPublisherOfItsTransformIsRefusedByName) {
  start();
  ASSERT_TRUE(hasStatus("OK"));
  ASSERT_TRUE(moreTransformsTo("base_link", 0));
  tf2_ros::TransformBroadcaster broadcaster;
  geometry_msgs::TransformStamped rival;
  rival.header.frame_id = "rival";
  rival.child_frame_id = "base_link";
  rival.transform.rotation.w = 1.0;
  ASSERT_TRUE(waitFor([&] {
    rival.header.stamp = ros::Time::now();
    broadcaster.sendTransform(rival);
    return node_->hasSaid("No transform is published: ");
  }));
  EXPECT_TRUE(node_->says(ros::this_node::getName() + " publishes tf rival -> base_link"));
  const std::size_t before = transformsTo("base_link"), poses = filtered_.count();
  ASSERT_TRUE(waitFor([&] { return filtered_.count() > poses + 20; }));
  EXPECT_LE(transformsTo("base_link"), before + 1);
  std_srvs::Trigger reset;
  ASSERT_TRUE(ros::service::call("vehicle_localizer/reset", reset));
  EXPECT_TRUE(moreTransformsTo("base_link", before + 1));
}

// Many launch files say `static_transform_publisher 0 0 0 0 0 0 map odom`. tf keeps the static one for ever and mixes
// it with ours; it was not heard, since it comes on another topic.
TEST_F(VehicleLocalizerTest, AStaticTransformIsARivalAfterAResetToo) {
  tf2_ros::StaticTransformBroadcaster broadcaster;
  geometry_msgs::TransformStamped rival;
  rival.header.frame_id = "map";
  rival.child_frame_id = "odom";
  rival.transform.rotation.w = 1.0;
  broadcaster.sendTransform(rival);
  start();
  for (int life = 0; life < 2; ++life) {
    const std::size_t poses = filtered_.count();
    ASSERT_TRUE(waitFor([&] { return filtered_.count() > poses + 20; }));
    EXPECT_TRUE(node_->says(ros::this_node::getName() + " publishes tf map -> odom too, a static"));
    EXPECT_EQ(transformsTo("odom"), 0U);
    std_srvs::Trigger reset;
    ASSERT_TRUE(ros::service::call("vehicle_localizer/reset", reset));
  }
}

TEST_F(VehicleLocalizerTest, WhatIsRefusedIsNamedInLogAndDiagnostics) {
  Latest<diagnostic_msgs::DiagnosticArray> diagnostics(nh_, "/diagnostics");
  start();
  ASSERT_TRUE(hasStatus("OK"));
  ros::Publisher dvl = nh_.advertise<geometry_msgs::TwistWithCovarianceStamped>("dvl/twist", 1);
  auto bad = stream_.dvl(ros::Time::now(), 0.0);
  bad.twist.covariance.fill(0.0);
  ASSERT_TRUE(waitFor([&] {
    bad.header.stamp = ros::Time::now();
    dvl.publish(bad);
    return node_->hasSaid("DVL refused: a variance is 0");
  }));
  EXPECT_TRUE(diagnostics.waitFor(0, [](const diagnostic_msgs::DiagnosticArray& array) {
    for (const auto& status : array.status)
      for (const auto& value : status.values)
        if (contains(status.name, "DVL") && contains(value.value, "a variance is 0")) return true;
    return false;
  }));
  SetPose call;
  call.request.pose.header.frame_id = "panel";
  ASSERT_TRUE(ros::service::call("vehicle_localizer/set_pose", call));
  EXPECT_FALSE(call.response.success);
  EXPECT_TRUE(contains(call.response.message, "must be map, got panel"));
}

}  // namespace
}  // namespace grid_path_planner::nodes
