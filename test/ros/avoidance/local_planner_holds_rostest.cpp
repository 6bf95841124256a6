// When local_planner stands although something is flown, and what it does not begin to fly.
//
// What was seen before: a path that path_planner had latched was flown by a local_planner that was started,
// or respawned, long after; with /clock standing still every cloud stayed new and the vehicle drove on; one
// cloud with stamp 0 after the start blinded it until it was restarted; the joystick gave the vehicle
// back to the flight by itself; ~cancel without a flight was a success.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_msgs/Bool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "grid_path_planner/AvoidanceStatus.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"

namespace grid_path_planner::nodes {
namespace {

using geometry_msgs::Twist;
using test::Latest;
using test::Process;

bool stands(const Twist& v) {
  return v.linear.x == 0.0 && v.linear.y == 0.0 && v.linear.z == 0.0 && v.angular.z == 0.0;
}
bool drives(const Twist& v) {
  return v.linear.x != 0.0 || v.linear.y != 0.0 || v.linear.z != 0.0;
}

// The sky about a vehicle that does not move: clouds in which no pixel measures anything, tf and /clock, any
// of which may cease.
class Sky {
 public:
  Sky() {
    thread_ = std::thread([this] {
      for (int i = 0; !done_; ++i) {
        tick(i % 5 == 0);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    });
  }
  ~Sky() {
    done_ = true;
    thread_.join();
  }

  ros::Time now() const { return ros::Time(time_.load()); }
  void jumpTo(double time) { time_ = time; }

  std::atomic<bool> clock_runs{true}, tf_comes{true}, clouds_come{true};

  void sendCloud(const ros::Time& stamp) {
    sensor_msgs::PointCloud2 cloud;
    cloud.header.frame_id = "/camera";  // with a slash, as old drivers have it
    cloud.header.stamp = stamp;
    cloud.height = kHeight;
    cloud.width = kWidth;
    sensor_msgs::PointCloud2Modifier modifier(cloud);
    modifier.setPointCloud2FieldsByString(1, "xyz");
    modifier.resize(kWidth * kHeight);
    cloud.height = kHeight;
    cloud.width = kWidth;
    cloud.row_step = kWidth * cloud.point_step;
    for (sensor_msgs::PointCloud2Iterator<float> x(cloud, "x"); x != x.end(); ++x)
      x[0] = x[1] = x[2] = std::numeric_limits<float>::quiet_NaN();
    sendCamera(stamp);
    clouds_.publish(cloud);
  }

 private:
  static constexpr int kWidth = 80, kHeight = 60;
  static constexpr double kFocal = 52.6;

  void tick(bool with_cloud) {
    if (clock_runs) time_ = time_ + 0.02;
    rosgraph_msgs::Clock clock;
    clock.clock = now();
    if (clock_runs) clock_.publish(clock);
    if (tf_comes) sendTransforms(clock.clock);
    if (clouds_come && with_cloud) sendCloud(clock.clock);
  }

  void sendTransforms(const ros::Time& stamp) {
    geometry_msgs::TransformStamped vehicle;
    vehicle.header.frame_id = "map";
    vehicle.header.stamp = stamp;
    vehicle.child_frame_id = "base_link";
    vehicle.transform.rotation.w = 1.0;
    geometry_msgs::TransformStamped camera = vehicle;
    camera.child_frame_id = "camera";
    camera.transform.rotation.w = camera.transform.rotation.y = 0.5;
    camera.transform.rotation.x = camera.transform.rotation.z = -0.5;
    broadcaster_.sendTransform({vehicle, camera});
  }

  void sendCamera(const ros::Time& stamp) {
    sensor_msgs::CameraInfo camera;
    camera.header.frame_id = "camera";
    camera.header.stamp = stamp;
    camera.width = kWidth;
    camera.height = kHeight;
    camera.K = {kFocal, 0.0, 0.5 * kWidth, 0.0, kFocal, 0.5 * kHeight, 0.0, 0.0, 1.0};
    cameras_.publish(camera);
  }

  std::atomic<double> time_{1e9};
  std::atomic<bool> done_{false};
  ros::NodeHandle nh_;
  ros::Publisher clock_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  ros::Publisher clouds_ = nh_.advertise<sensor_msgs::PointCloud2>("points", 10);
  ros::Publisher cameras_ = nh_.advertise<sensor_msgs::CameraInfo>("camera_info", 10);
  tf2_ros::TransformBroadcaster broadcaster_;
  std::thread thread_;
};

class HoldsTest : public testing::Test {
 protected:
  void start() {
    pilot_ = std::make_unique<Process>(
        "local_planner",
        std::vector<std::string>{"_no_return_clears:=10", "_recover:=false", "_cloud_timeout:=5",
                                 "_tf_timeout:=1", "_stuck_timeout:=1e6"});
    ASSERT_TRUE(test::waitFor([] { return ros::service::exists("/local_planner/cancel", false); }));
    ASSERT_TRUE(test::waitFor([&] { return commands_.connected() && statuses_.connected(); }));
    ASSERT_TRUE(test::waitFor([&] {
      return goals_.getNumSubscribers() > 0 && stops_.getNumSubscribers() > 0 &&
             manuals_.getNumSubscribers() > 0 && paths_.getNumSubscribers() > 0;
    }));
    ASSERT_TRUE(says("IDLE")) << "it knows when it started";
  }
  void startAndFly() {
    ASSERT_NO_FATAL_FAILURE(start());
    sendGoal(ros::Time());
    ASSERT_TRUE(flies()) << said();
  }

  void sendGoal(const ros::Time& stamp) {
    geometry_msgs::PoseStamped goal;
    goal.header.frame_id = "/map";
    goal.header.stamp = stamp;
    goal.pose.position.x = 40.0;
    goal.pose.orientation.w = 1.0;
    goals_.publish(goal);
  }
  void sendPath(const ros::Time& stamp, const std::vector<double>& along) {
    nav_msgs::Path path;
    path.header.frame_id = "map";
    path.header.stamp = stamp;
    for (const double x : along) {
      path.poses.emplace_back();
      path.poses.back().header = path.header;
      path.poses.back().pose.position.x = x;
      path.poses.back().pose.orientation.w = 1.0;
    }
    paths_.publish(path);
  }
  static void send(const ros::Publisher& topic, bool value) {
    std_msgs::Bool message;
    message.data = value;
    topic.publish(message);
  }
  static std_srvs::Trigger::Response call(const std::string& service) {
    std_srvs::Trigger trigger;
    EXPECT_TRUE(ros::service::call("/local_planner/" + service, trigger));
    return trigger.response;
  }

  // A command that moves the vehicle comes from now on.
  bool flies() const { return commands_.waitFor(commands_.count(), drives).has_value(); }
  // From now on a status comes with this sentence, and after it no command but zeros.
  ::testing::AssertionResult standsSaying(const std::string& words) {
    if (!says(words)) return ::testing::AssertionFailure() << said();
    const std::size_t from = commands_.count();
    if (!commands_.waitForMoreThan(from + 10))
      return ::testing::AssertionFailure() << "no commands come";
    const auto all = commands_.all();
    const bool zeros = std::all_of(all.begin() + static_cast<std::ptrdiff_t>(from) + 1, all.end(),
                                   stands);  // one may have been sent before
    return zeros ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << "it drives";
  }
  // The newest command is a zero, now or soon.
  bool endsInAZero() const {
    return test::waitFor([&] { return stands(commands_.all().back()); });
  }
  // The newest status has this in its name or sentence, now or soon.
  bool says(const std::string& words) const {
    return test::waitFor([&] {
      const auto all = statuses_.all();
      return !all.empty() &&
             (all.back().status + ": " + all.back().sentence).find(words) != std::string::npos;
    });
  }
  std::string said() const {
    std::string text;
    for (const AvoidanceStatus& status : statuses_.all())
      text += status.status + ": " + status.sentence + "\n";
    return text;
  }

  ros::NodeHandle nh_;
  Latest<Twist> commands_{nh_, "cmd_vel"};
  Latest<AvoidanceStatus> statuses_{nh_, "avoidance_status"};
  ros::Publisher goals_ = nh_.advertise<geometry_msgs::PoseStamped>("goal", 1);
  ros::Publisher paths_ = nh_.advertise<nav_msgs::Path>("path", 1, true);
  ros::Publisher stops_ = nh_.advertise<std_msgs::Bool>("stop", 1);
  ros::Publisher manuals_ = nh_.advertise<std_msgs::Bool>("manual_control", 1);
  Sky sky_;
  std::unique_ptr<Process> pilot_;
};

TEST_F(HoldsTest, StopStopsAndLetsGo) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  send(stops_, true);
  EXPECT_TRUE(standsSaying("stopped by the topic stop"));
  send(stops_, false);
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, AJoystickPausesUntilResume) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  send(manuals_, true);
  ASSERT_TRUE(says("the joystick commands")) << said();
  const std::size_t before = commands_.count();
  for (int i = 0; i < 10; ++i) {
    send(manuals_, true);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_LE(commands_.count(), before + 1) << "the joystick's commands are in force";
  EXPECT_FALSE(call("resume").success);
  send(manuals_, false);
  EXPECT_TRUE(standsSaying("paused until ~resume"));
  EXPECT_TRUE(call("resume").success);
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, ServicesSayWhetherTheyDidAnything) {
  ASSERT_NO_FATAL_FAILURE(start());
  for (const char* service : {"pause", "resume", "cancel"})
    EXPECT_FALSE(call(service).success) << service;
  sendGoal(sky_.now());
  ASSERT_TRUE(flies()) << said();
  EXPECT_TRUE(call("pause").success);
  EXPECT_TRUE(standsSaying("paused until ~resume"));
  EXPECT_TRUE(call("resume").success);
  EXPECT_TRUE(flies()) << said();
  EXPECT_TRUE(call("cancel").success);
  EXPECT_TRUE(says("CANCELLED")) << said();
  EXPECT_TRUE(endsInAZero());
  EXPECT_FALSE(call("cancel").success);
}

TEST_F(HoldsTest, APathIsFlownUntilAnEmptyOneComes) {
  ASSERT_NO_FATAL_FAILURE(start());
  sendPath(sky_.now(), {0.0, 10.0, 20.0, 40.0});
  ASSERT_TRUE(flies()) << said();
  sendPath(sky_.now(), {});
  EXPECT_TRUE(says("CANCELLED: cancelled: the path is empty")) << said();
  EXPECT_TRUE(endsInAZero());
}

TEST_F(HoldsTest, WhatIsFromBeforeTheStartIsNotFlown) {
  sendPath(sky_.now(), {0.0, 10.0, 20.0, 40.0});
  const ros::Time before = sky_.now();
  ASSERT_TRUE(test::waitFor([&] { return sky_.now() > before + ros::Duration(1.0); }));
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_TRUE(pilot_->says("A path stamped"));
  sendGoal(before);
  ASSERT_TRUE(pilot_->says("A goal stamped"));
  const ros::Time then = sky_.now();
  ASSERT_TRUE(test::waitFor([&] { return sky_.now() > then + ros::Duration(1.0); }));
  EXPECT_EQ(commands_.count(), 0u);
  EXPECT_TRUE(says("IDLE")) << said();
  sendPath(sky_.now(), {0.0, 10.0, 20.0, 40.0});
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, TfThatCeasesStopsIt) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  sky_.tf_comes = false;
  EXPECT_TRUE(standsSaying("TRANSFORM_ERROR"));
  sky_.tf_comes = true;
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, AClockThatStandsStillStopsIt) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  sky_.clock_runs = false;
  EXPECT_TRUE(standsSaying("ROS time stands still"));
  sky_.clock_runs = true;
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, TimeThatGoesBackCancelsAndANewGoalIsFlown) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  sky_.jumpTo(5e8);
  EXPECT_TRUE(says("CANCELLED: time went back")) << said();
  EXPECT_TRUE(endsInAZero());
  sendGoal(sky_.now());
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, ACloudStampedZeroBlindsNobody) {
  sky_.clouds_come = false;
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_TRUE(says("IDLE"));
  const ros::Time before = sky_.now();  // tf is known
  ASSERT_TRUE(test::waitFor([&] { return sky_.now() > before + ros::Duration(0.5); }));
  sky_.sendCloud(ros::Time());
  sendGoal(sky_.now());
  EXPECT_TRUE(says("NO_CLOUD")) << said();
  sky_.clouds_come = true;
  EXPECT_TRUE(flies()) << said();
}

// Under the sanitizers the node ended when it remembered nothing and someone asked to see that: the
// iterator over a cloud without points took a reference to its first byte.
TEST_F(HoldsTest, NothingRememberedIsShownAsACloudWithoutPoints) {
  const Latest<sensor_msgs::PointCloud2> remembered(nh_, "remembered_points");
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  const auto cloud = remembered.waitFor(0, [](const auto& cloud) { return cloud.width == 0; });
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->fields.size(), 3U);
  EXPECT_TRUE(flies()) << said();
}

TEST_F(HoldsTest, SigtermInFlightIsFollowedByAZero) {
  ASSERT_NO_FATAL_FAILURE(startAndFly());
  pilot_->end(SIGTERM);
  EXPECT_TRUE(endsInAZero());
}

}  // namespace
}  // namespace grid_path_planner::nodes
