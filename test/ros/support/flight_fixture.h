// A local_planner and the sky about a vehicle that does not move, for rostests.
#pragma once

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

namespace grid_path_planner::test {

inline bool stands(const geometry_msgs::Twist& v) {
  return v.linear.x == 0.0 && v.linear.y == 0.0 && v.linear.z == 0.0 && v.angular.z == 0.0;
}
inline bool drives(const geometry_msgs::Twist& v) {
  return v.linear.x != 0.0 || v.linear.y != 0.0 || v.linear.z != 0.0;
}

// The sky about a vehicle that does not move by itself: clouds in which no pixel measures anything, tf and /clock, any
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
  std::atomic<double> vehicle_x{0.0};  // m

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
    vehicle.transform.translation.x = vehicle_x;
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

class FlightTest : public testing::Test {
 protected:
  FlightTest() { ros::param::del("/local_planner"); }  // what the test before has set

  // Of a flight that nothing ends.
  static std::vector<std::string> arguments(const std::vector<std::string>& more = {}) {
    std::vector<std::string> all{"_no_return_clears:=10", "_recover:=false", "_cloud_timeout:=5",
                                 "_tf_timeout:=1", "_stuck_timeout:=1e6"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  void start(const std::vector<std::string>& more = {}) {
    pilot_ = std::make_unique<Process>("local_planner", arguments(more));
    ASSERT_NO_FATAL_FAILURE(waitUntilItIsUp());
  }
  void waitUntilItIsUp() {
    ASSERT_TRUE(test::waitFor([] { return ros::service::exists("/local_planner/cancel", false); }));
    ASSERT_TRUE(test::waitFor([&] { return commands_.connected() && statuses_.connected(); }));
    ASSERT_TRUE(test::waitFor([&] {
      return goals_.getNumSubscribers() > 0 && stops_.getNumSubscribers() > 0 &&
             manuals_.getNumSubscribers() > 0 && paths_.getNumSubscribers() > 0;
    }));
    ASSERT_TRUE(says("IDLE")) << "it knows when it started";
  }
  void startAndFly(const std::vector<std::string>& more = {}) {
    ASSERT_NO_FATAL_FAILURE(start(more));
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
  Latest<geometry_msgs::Twist> commands_{nh_, "cmd_vel"};
  Latest<AvoidanceStatus> statuses_{nh_, "avoidance_status"};
  ros::Publisher goals_ = nh_.advertise<geometry_msgs::PoseStamped>("goal", 1);
  ros::Publisher paths_ = nh_.advertise<nav_msgs::Path>("path", 1, true);
  ros::Publisher stops_ = nh_.advertise<std_msgs::Bool>("stop", 1);
  ros::Publisher manuals_ = nh_.advertise<std_msgs::Bool>("manual_control", 1);
  Sky sky_;
  std::unique_ptr<Process> pilot_;
};

}  // namespace grid_path_planner::test
