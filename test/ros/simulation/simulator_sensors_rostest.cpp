// The navigation sensors of the simulator, in test/data/pool.sdf: a floor at z = -2.
#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <set>

#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "support/temporary_folder.h"

namespace grid_path_planner::nodes {
namespace {

using geometry_msgs::PoseWithCovarianceStamped;
using geometry_msgs::TwistWithCovarianceStamped;
using nav_msgs::Odometry;
using sensor_msgs::FluidPressure;
using sensor_msgs::Imu;
using sensor_msgs::LaserScan;
using sensor_msgs::Range;
using test::Latest;
using test::Process;

const std::vector<std::string> kAllSensors = {"_imu_enabled:=true", "_dvl_enabled:=true",
                                              "_pressure_enabled:=true", "_usbl_enabled:=true",
                                              "_laser_enabled:=true"};

const std::string kSensorFrames[] = {"imu_link",      "dvl_link",  "dvl_altitude_link",
                                     "pressure_link", "usbl_link", "laser_link"};

std::set<std::string> publishedTopics() {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  std::set<std::string> names;
  for (const auto& topic : topics) names.insert(topic.name);
  return names;
}

class SimulatorSensors : public testing::Test {
 protected:
  SimulatorSensors() { ros::param::del("/simulator"); }

  void start(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--world=" GPP_TEST_DATA "/pool.sdf", "_camera_width:=8",
                                       "_camera_height:=6"});
    simulator_ = std::make_unique<Process>("simulator", arguments);
    ASSERT_TRUE(truth_.waitForMoreThan(truth_.count())) << simulator_->output();
  }

  void startAll(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), kAllSensors.begin(), kAllSensors.end());
    start(arguments);
  }

  bool knows(const std::string& frame, const std::string& child) const {
    return buffer_.canTransform(frame, child, ros::Time(0));
  }

  ros::NodeHandle nh_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_{buffer_};
  Latest<Odometry> truth_{nh_, "ground_truth"};
  std::unique_ptr<Process> simulator_;
};

// Consecutive messages are `period` apart, whenever they came.
template <class Message>
void expectPeriod(const std::vector<Message>& messages, double period) {
  for (std::size_t i = 1; i < messages.size(); ++i) {
    const double apart = (messages[i].header.stamp - messages[i - 1].header.stamp).toSec();
    EXPECT_NEAR(apart, period, 0.0101) << "message " << i << ", to a step";
  }
}

TEST_F(SimulatorSensors, SpeakAtTheirRatesInTheirFramesWithTheirCovariances) {
  Latest<Imu> imu(nh_, "imu/data");
  Latest<TwistWithCovarianceStamped> twist(nh_, "dvl/twist");
  Latest<Range> altitude(nh_, "dvl/altitude");
  Latest<FluidPressure> pressure(nh_, "pressure");
  Latest<PoseWithCovarianceStamped> depth(nh_, "depth");
  startAll({"_real_time_factor:=3"});
  ASSERT_TRUE(test::waitFor([&] {
    return imu.count() > 100 && twist.count() > 10 && altitude.count() > 10 && depth.count() > 10;
  }));

  const std::vector<Imu> units = imu.all();
  for (std::size_t i = 1; i < units.size(); ++i)
    EXPECT_EQ((units[i].header.stamp - units[i - 1].header.stamp).toNSec(), 10000000);
  EXPECT_EQ(units[0].header.frame_id, "imu_link");
  EXPECT_NEAR(units[0].linear_acceleration.z, 9.80665, 1.0) << "upwards, as REP 145 has it";
  EXPECT_NEAR(units[0].linear_acceleration_covariance[8], 0.004 * 0.004 * 100.0, 1e-9);
  EXPECT_NEAR(units[0].angular_velocity_covariance[0], std::pow(3.394e-4, 2) * 100.0, 1e-12);
  EXPECT_NEAR(units[0].orientation_covariance[0], 1e-4, 1e-12);
  EXPECT_GT(units[1].orientation_covariance[8], units[0].orientation_covariance[8]);

  expectPeriod(twist.all(), 1.0 / 7.0);
  const TwistWithCovarianceStamped velocity = twist.all().back();
  EXPECT_EQ(velocity.header.frame_id, "dvl_link");
  EXPECT_NEAR(velocity.twist.twist.linear.x, 0.0, 0.05);
  EXPECT_NEAR(velocity.twist.covariance[0], 2.0 * 2.5e-5, 1e-8);
  EXPECT_NEAR(velocity.twist.covariance[14], 2.5e-5 / 3.0, 1e-8);
  EXPECT_EQ(velocity.twist.covariance[21], 1e6) << "turns are not measured";

  const Range bottom = altitude.all().back();
  EXPECT_EQ(bottom.header.frame_id, "dvl_altitude_link");
  EXPECT_NEAR(bottom.range, 1.8, 1e-4);

  expectPeriod(pressure.all(), 0.1);
  EXPECT_EQ(pressure.all()[0].header.frame_id, "pressure_link");
  EXPECT_NEAR(pressure.all()[0].fluid_pressure, 101325.0 + 1025.0 * 9.80665 * 7.0, 1200.0);
  EXPECT_EQ(pressure.all()[0].variance, 40000.0);
  EXPECT_EQ(depth.all()[0].header.frame_id, "map");
  EXPECT_NEAR(depth.all()[0].pose.pose.position.z, 0.0, 0.12);
  EXPECT_NEAR(depth.all()[0].pose.covariance[14], std::pow(200.0 / (1025.0 * 9.80665), 2), 1e-9);
  EXPECT_EQ(depth.all()[0].pose.covariance[0], 1e6) << "x is not measured";
}

// The wall is 4 m ahead of base_link.
TEST_F(SimulatorSensors, ALaserSeesTheWall) {
  Latest<LaserScan> scans(nh_, "scan");
  startAll({"_real_time_factor:=3", "_laser_x:=0.5", "_laser_rays:=181",
            "_laser_field_of_view:=3.0", "_laser_noise:=0.001"});
  ASSERT_TRUE(scans.waitForMoreThan(10));
  expectPeriod(scans.all(), 0.1);
  const LaserScan scan = scans.all().back();
  EXPECT_EQ(scan.header.frame_id, "laser_link");
  ASSERT_EQ(scan.ranges.size(), 181u);
  EXPECT_NEAR(scan.angle_min, -1.5, 1e-6);
  EXPECT_NEAR(scan.angle_max, 1.5, 1e-6);
  EXPECT_NEAR(scan.angle_increment, 3.0 / 180, 1e-6);
  EXPECT_NEAR(scan.ranges[90], 3.5, 0.01);
  EXPECT_NEAR(scan.ranges[150], 3.5 / std::cos(1.0), 0.01);
  EXPECT_TRUE(std::isinf(scan.ranges[0])) << "it would be 49 m";
  EXPECT_TRUE(test::waitFor([&] { return knows("base_link", "laser_link"); }));
}

// Never a static one: tf would keep it for ever, and a bag of /tf alone would lack it.
TEST_F(SimulatorSensors, HaveFramesInTf) {
  Latest<tf2_msgs::TFMessage> fixed(nh_, "/tf_static");
  startAll({"_dvl_x:=0.4"});
  ASSERT_TRUE(test::waitFor([&] {
    return knows("base_link", "imu_link") && knows("base_link", "dvl_altitude_link") &&
           knows("base_link", "pressure_link") && knows("base_link", "usbl_link");
  }));
  const auto dvl = buffer_.lookupTransform("base_link", "dvl_link", ros::Time(0)).transform;
  EXPECT_EQ(dvl.translation.x, 0.4);
  EXPECT_EQ(dvl.translation.z, -0.2);
  // x of the altitude looks down, as the axis of a Range does: a turn of 90 degrees about y.
  const auto down =
      buffer_.lookupTransform("dvl_link", "dvl_altitude_link", ros::Time(0)).transform;
  EXPECT_NEAR(down.rotation.y, std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(down.rotation.w, std::sqrt(0.5), 1e-9);
  for (const tf2_msgs::TFMessage& message : fixed.all())
    for (const auto& transform : message.transforms)
      EXPECT_EQ(
          std::count(std::begin(kSensorFrames), std::end(kSensorFrames), transform.child_frame_id),
          0)
          << transform.child_frame_id;
}

// Fixes are of whole seconds, and nobody knows them for 0.6 s.
TEST_F(SimulatorSensors, AnAcousticFixComesLateWithTheStampOfThen) {
  std::mutex mutex;  // of the two
  std::vector<double> late, stamps;
  const auto listen = nh_.subscribe<PoseWithCovarianceStamped>(
      "usbl/pose", 100, [&](const PoseWithCovarianceStamped::ConstPtr& fix) {
        const std::lock_guard<std::mutex> lock(mutex);
        late.push_back((ros::Time::now() - fix->header.stamp).toSec());
        stamps.push_back(fix->header.stamp.toSec());
        EXPECT_EQ(fix->header.frame_id, "map");
        EXPECT_GE(fix->pose.covariance[0], 0.0);
        EXPECT_EQ(fix->pose.covariance[21], 1e6) << "turns are not measured";
      });
  startAll({"_real_time_factor:=3", "_start_time:=100", "_usbl_outlier_share:=0"});
  ASSERT_TRUE(test::waitFor([&] {
    const std::lock_guard<std::mutex> lock(mutex);
    return stamps.size() >= 4 && *std::max_element(late.begin(), late.end()) > 0.5;
  })) << "0.6 s, where /clock comes in time";
  const std::lock_guard<std::mutex> lock(mutex);
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    EXPECT_NEAR(stamps[i], std::round(stamps[i]), 1e-9);
  }
}

// A vehicle without navigation sensors has no topics and no frames of them: as it was before there were any.
TEST_F(SimulatorSensors, AreOffByDefaultAndSwitchedOnByReconfiguring) {
  start({});
  ASSERT_TRUE(test::waitFor([&] { return knows("map", "base_link"); }));
  EXPECT_FALSE(knows("base_link", "imu_link"));
  EXPECT_EQ(publishedTopics().count("/imu/data"), 0u);
  const Odometry truth = truth_.all().back();
  EXPECT_EQ(truth.pose.pose.orientation.x, 0.0);
  EXPECT_EQ(truth.twist.twist.angular.x, 0.0);

  Latest<Imu> imu(nh_, "imu/data");
  dynamic_reconfigure::Reconfigure call;
  dynamic_reconfigure::BoolParameter enabled;
  enabled.name = "imu_enabled";
  enabled.value = true;
  call.request.config.bools = {enabled};
  ASSERT_TRUE(ros::service::call("/simulator/set_parameters", call));
  EXPECT_TRUE(imu.waitForMoreThan(10));
  EXPECT_TRUE(test::waitFor([&] { return knows("base_link", "imu_link"); }));
}

TEST_F(SimulatorSensors, LeaveOdomToBaseToALocalisationWhereAsked) {
  start({"_publish_odom_to_base:=false"});
  ASSERT_TRUE(test::waitFor(
      [&] { return knows("base_link", "camera_link") && buffer_._frameExists("odom"); }));
  ASSERT_TRUE(truth_.waitForMoreThan(truth_.count() + 10));
  EXPECT_FALSE(knows("odom", "base_link"));
}

TEST_F(SimulatorSensors, AVehicleThatRocksIsTurnedInTfAndInTheTruth) {
  start({"_roll_amplitude:=0.2", "_roll_period:=1.0"});
  const auto rolled = truth_.waitFor(
      0, [](const Odometry& o) { return std::abs(o.pose.pose.orientation.x) > 0.09; });
  ASSERT_TRUE(rolled);
  EXPECT_NEAR(rolled->pose.pose.orientation.y, 0.0, 1e-9);
  ASSERT_TRUE(test::waitFor(
      [&] { return buffer_.canTransform("map", "base_link", rolled->header.stamp); }));
  const auto tf = buffer_.lookupTransform("map", "base_link", rolled->header.stamp).transform;
  EXPECT_NEAR(tf.rotation.x, rolled->pose.pose.orientation.x, 1e-9);
}

TEST_F(SimulatorSensors, AFaultFileCutsThem) {
  const test::TemporaryFolder folder;
  Latest<TwistWithCovarianceStamped> twist(nh_, "dvl/twist");
  startAll({"--sensor-faults=" + folder.write("faults.yaml",
                                              "faults:\n"
                                              "  - {sensor: dvl, from: 0, to: 2, kind: cut}\n"),
            "_start_time:=50"});
  const auto first = twist.waitForMoreThan(0);
  ASSERT_TRUE(first);
  EXPECT_GE(twist.all()[0].header.stamp.toSec(), 52.0);
}

TEST_F(SimulatorSensors, WhatCannotBeUsedEndsItBeforeItStarts) {
  const test::TemporaryFolder folder;
  const std::string faults =
      folder.write("faults.yaml", "faults:\n  - {sensor: sonar, from: 0, to: 2, kind: cut}\n");
  Process wrong("simulator", {"--sensor-faults=" + faults});
  ASSERT_TRUE(wrong.waitForExit());
  EXPECT_EQ(wrong.exitCode(), 1);
  EXPECT_NE(wrong.output().find(faults + ":2: sensor must be one of"), std::string::npos)
      << wrong.output();
  Process blind("simulator", {"_dvl_enabled:=true"});
  ASSERT_TRUE(blind.waitForExit());
  EXPECT_EQ(blind.exitCode(), 1);
  EXPECT_NE(blind.output().find("needs a world"), std::string::npos) << blind.output();
  ros::param::del("/simulator");
  Process fast("simulator", {"_imu_enabled:=true", "_imu_rate:=500"});
  ASSERT_TRUE(fast.waitForExit());
  EXPECT_EQ(fast.exitCode(), 1);
}

// Several steps may be made in one tick of a busy machine, whose messages must not bear one stamp.
TEST_F(SimulatorSensors, WithoutAClockOfItsOwnStampsAreThoseAtWhichStepsWereDue) {
  Latest<Imu> imu(nh_, "imu/data");
  ros::param::set("/use_sim_time", false);
  start({"_publish_clock:=false", "_imu_enabled:=true", "_update_rate:=10"});
  const bool enough = test::waitFor([&] { return imu.count() > 60; });
  ros::param::set("/use_sim_time", true);
  ASSERT_TRUE(enough);
  const std::vector<Imu> all = imu.all();
  for (std::size_t i = 1; i < all.size(); ++i)
    EXPECT_GT(all[i].header.stamp, all[i - 1].header.stamp) << i;
  EXPECT_LE(all.back().header.stamp.toSec(), ros::WallTime::now().toSec());
}

// Where another node's clock ticks less often than the simulator, the readings between its ticks vanished.
TEST_F(SimulatorSensors, ReadingsWaitForAClockThatStands) {
  constexpr double period = 0.5;  // s
  Latest<Imu> imu(nh_, "imu/data");
  const ros::Publisher clocks = nh_.advertise<rosgraph_msgs::Clock>("/clock", 1);
  rosgraph_msgs::Clock clock;
  clock.clock = ros::Time(1000.0);
  const auto ticks =
      nh_.createSteadyTimer(ros::WallDuration(period), [&](const ros::SteadyTimerEvent&) {
        clock.clock += ros::Duration(period);
        clocks.publish(clock);
      });
  start({"_publish_clock:=false", "_imu_enabled:=true", "_imu_rate:=100"});
  EXPECT_TRUE(test::waitFor([&] {
    std::map<int, int> between;  // ticks of the clock
    for (const Imu& unit : imu.all())
      ++between[static_cast<int>(unit.header.stamp.toSec() / period)];
    return std::any_of(between.begin(), between.end(),
                       [](const auto& readings) { return readings.second > 20; });
  })) << "of 50, of which a late tick of the simulator alone has 6";
}

}  // namespace
}  // namespace grid_path_planner::nodes
