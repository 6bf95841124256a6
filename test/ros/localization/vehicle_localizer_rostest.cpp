#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <chrono>
#include <limits>
#include <map>
#include <set>
#include <thread>

#include "grid_path_planner/SetPose.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "ros/support/sensor_stream.h"
#include "support/error_text.h"

namespace grid_path_planner::nodes {
namespace {

using test::contains;
using test::Latest;
using test::LiveStream;
using test::Process;
using test::SensorStream;
using test::waitFor;

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
  std::vector<ros::Time> stampsTo(const std::string& child) const {
    std::vector<ros::Time> stamps;
    for (const tf2_msgs::TFMessage& message : tf_.all())
      for (const auto& transform : message.transforms)
        if (transform.child_frame_id == child) stamps.push_back(transform.header.stamp);
    return stamps;
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
  EXPECT_EQ(all.back().header.frame_id, "map");
  EXPECT_EQ(all.back().child_frame_id, "base_link");
}

// rl#336, rl#574: a transform whose stamp came before makes tf2 warn for ever. By stamps, whatever the machine's load: the
// IMU's are 10 ms apart and every second one is published.
TEST_F(VehicleLocalizerTest, EachTransformHasANewStamp50TimesASecond) {
  start();
  ASSERT_TRUE(hasStatus("OK"));
  for (const char* child : {"odom", "base_link"}) {
    const std::size_t before = transformsTo(child);
    ASSERT_TRUE(moreTransformsTo(child, before + 60));
    const std::vector<ros::Time> stamps = stampsTo(child);
    for (std::size_t i = 1; i < stamps.size(); ++i) EXPECT_LT(stamps[i - 1], stamps[i]) << child;
    const double seconds = (stamps.back() - stamps[before]).toSec();
    const double rate = static_cast<double>(stamps.size() - 1 - before) / seconds;
    EXPECT_LT(rate, 51.0) << child;
    EXPECT_GT(rate, 20.0) << child;  // less than 50 where the machine keeps the IMU's messages back
  }
}

// Without any fix somebody who knows it says where the vehicle is, by service or with rviz, and again where it is put.
TEST_F(VehicleLocalizerTest, APoseThatIsSetIsTakenByServiceAndByTopic) {
  stream_.sends_fixes = false;
  ros::Publisher initial = nh_.advertise<SensorStream::Fix>("initialpose", 1);
  start();
  ASSERT_TRUE(waitFor([&] { return transformsTo("base_link") > 0; })) << "the IMU is heard";
  EXPECT_EQ(filtered_.count(), 0u);
  SetPose call;
  const ros::Time now = ros::Time::now();
  call.request.pose = stream_.marker(now, live_->secondsAt(now));
  ASSERT_TRUE(ros::service::call("vehicle_localizer/set_pose", call));
  EXPECT_TRUE(call.response.success) << call.response.message;
  ASSERT_TRUE(waitFor([&] { return filtered_.count() > 5; }));
  EXPECT_LT(errorOf(filtered_.all().back()), 0.2);
  ASSERT_TRUE(waitFor([&] { return initial.getNumSubscribers() > 0; }));
  const ros::Time later = ros::Time::now();
  SensorStream::Fix elsewhere = stream_.marker(later, live_->secondsAt(later));
  elsewhere.pose.pose.position.x += 5.0;
  initial.publish(elsewhere);
  ASSERT_TRUE(waitFor([&] { return errorOf(filtered_.all().back()) > 4.0; }));
  EXPECT_NEAR(errorOf(filtered_.all().back()), 5.0, 0.3);
}

TEST_F(VehicleLocalizerTest, DiagnosticsTellRateAgeCountsAndNisOfEachInput) {
  Latest<diagnostic_msgs::DiagnosticArray> diagnostics(nh_, "/diagnostics");
  start();
  ASSERT_TRUE(hasStatus("OK"));
  const auto number = [](const diagnostic_msgs::DiagnosticStatus& status, const std::string& key) {
    for (const auto& value : status.values)
      if (value.key == key) return std::stod(value.value);
    ADD_FAILURE() << status.name << " does not tell " << key;
    return 0.0;
  };
  std::map<std::string, diagnostic_msgs::DiagnosticStatus> told;
  ASSERT_TRUE(diagnostics.waitFor(0, [&](const diagnostic_msgs::DiagnosticArray& array) {
    for (const auto& status : array.status) told[status.name] = status;
    const auto dvl = told.find("vehicle_localizer: DVL");
    return dvl != told.end() && dvl->second.message == "used" && number(dvl->second, "taken") > 10;
  }));
  const std::map<std::string, double> rates = {
      {"IMU", 100.0}, {"DVL", 7.1}, {"depth", 10.0}, {"USBL", 5.0}};
  for (const auto& [name, rate] : rates) {
    const auto& status = told["vehicle_localizer: " + name];
    EXPECT_NEAR(number(status, "rate (Hz)"), rate, 0.1 * rate) << name;
    EXPECT_LT(number(status, "age (s)"), 2.0) << name;
    EXPECT_GT(number(status, "taken"), 0.0) << name;
    EXPECT_EQ(number(status, "gated"), 0.0) << name;
    EXPECT_GE(number(status, "refused"), 0.0) << name;  // before tf knew its frame
    if (name == "IMU") continue;
    EXPECT_LT(number(status, "NIS, 95 % low"), number(status, "NIS, 95 % high")) << name;
    EXPECT_LT(number(status, "NIS, mean"), number(status, "NIS, 95 % high")) << name;
  }
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

// Sensors are lost, the pose is LOST, map -> odom ceases, and the vehicle that drives on it stands.
TEST_F(VehicleLocalizerTest, ADriveStandsWhileThePoseIsLostAndGoesOnAfterwards) {
  ros::param::del("/navigate_path");
  Latest<geometry_msgs::Twist> commands(nh_, "cmd_vel");
  ros::Publisher paths = nh_.advertise<nav_msgs::Path>("path", 1);
  start({"_max_deviation:=0.3"});
  ASSERT_TRUE(hasStatus("OK"));
  // The stream moves whatever is commanded: how far it came while LOST is no jump to end the drive for.
  const Process navigate("navigate_path",
                         {"_check_map:=false", "_no_progress_timeout:=0", "_pose_jump:=0"});
  ASSERT_TRUE(waitFor([&] { return paths.getNumSubscribers() > 0 && commands.connected(); }));
  nav_msgs::Path path;
  path.header.frame_id = "map";
  path.header.stamp = ros::Time::now();
  path.poses.resize(2);
  for (auto& pose : path.poses) {
    pose.pose.position = filtered_.all().back().pose.pose.position;
    pose.pose.orientation.w = 1.0;
  }
  path.poses[1].pose.position.x += 100.0;
  const auto is_moved = [&] {
    const auto all = commands.all();
    if (all.empty()) return false;
    const geometry_msgs::Vector3& v = all.back().linear;
    return v.x != 0.0 || v.y != 0.0 || v.z != 0.0;
  };
  const auto drives = [&](bool wanted) { return waitFor([&] { return is_moved() == wanted; }); };
  // One that comes before the transforms is refused.
  ASSERT_TRUE(waitFor([&] {
    if (!is_moved()) paths.publish(path);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    return is_moved();
  })) << navigate.output();
  stream_.sends_dvl = stream_.sends_fixes = false;
  ASSERT_TRUE(hasStatus("LOST"));
  EXPECT_TRUE(drives(false)) << navigate.output();
  // DEGRADED for reset_doubt, since the commands were not obeyed, but known.
  stream_.sends_dvl = stream_.sends_fixes = true;
  EXPECT_TRUE(drives(true)) << navigate.output();
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
  geometry_msgs::TransformStamped map_in_earth = in_map, on_ship = in_map;
  map_in_earth.header.frame_id = on_ship.header.frame_id = "earth";
  map_in_earth.child_frame_id = "map";
  on_ship.child_frame_id = "ship_dvl";
  fixed.sendTransform(std::vector<geometry_msgs::TransformStamped>{in_map, map_in_earth, on_ship});
  ros::Publisher others = nh_.advertise<geometry_msgs::TwistWithCovarianceStamped>("dvl/twist", 1);
  start();
  ASSERT_TRUE(hasStatus("OK"));
  const auto refuses = [&](const std::string& frame) {
    const ros::Time now = ros::Time::now();
    auto twist = stream_.dvl(now, live_->secondsAt(now));
    twist.header.frame_id = frame;
    others.publish(twist);
    return node_->hasSaid("tf has '" + frame + "' by map, not on the vehicle");
  };
  for (const char* frame : {"fixed_dvl", "ship_dvl"})
    EXPECT_TRUE(waitFor([&] { return refuses(frame); })) << node_->output();
}

// 1.2 s may be written as 0 s and 1.2e9 ns, which roscpp compares and adds as another time.
TEST_F(VehicleLocalizerTest, AStampIsPublishedWithLessThanASecondOfNanoseconds) {
  ros::Publisher others = nh_.advertise<sensor_msgs::Imu>("imu/data", 100);
  start();
  ASSERT_TRUE(hasStatus("OK"));
  stream_.sends_imu = false;
  std::set<ros::Time> sent;
  ASSERT_TRUE(waitFor([&] {
    const ros::Time now = ros::Time::now();
    sensor_msgs::Imu imu = stream_.imu(now, live_->secondsAt(now));
    imu.header.stamp.sec -= 1;
    imu.header.stamp.nsec += 1'000'000'000;
    others.publish(imu);
    sent.insert(now);
    const auto all = filtered_.all();
    return !all.empty() && sent.count(all.back().header.stamp) > 0;
  })) << node_->output();
  for (const nav_msgs::Odometry& odometry : filtered_.all())
    ASSERT_LT(odometry.header.stamp.nsec, 1'000'000'000u);
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
    return node_->hasSaid("is refused: a variance is 0");
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
