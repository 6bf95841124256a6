// A navigate_path and what it needs around it, for rostests: the simulator, or a world that the
// test itself moves.
#pragma once

#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "grid_path_planner/ros/conversions.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"

namespace grid_path_planner::test {

// Poses of x, y, z, yaw (0 where left out) in the frame map.
inline path::Path pathOf(const std::vector<std::vector<double>>& poses) {
  path::Path path;
  for (const auto& p : poses)
    path.poses.push_back(
        {Eigen::Vector3d(p.at(0), p.at(1), p.size() > 2 ? p[2] : 0.0), p.size() > 3 ? p[3] : 0.0});
  return path;
}

inline bool isZero(const geometry_msgs::Twist& twist) {
  return twist.linear.x == 0.0 && twist.linear.y == 0.0 && twist.linear.z == 0.0 &&
         twist.angular.z == 0.0;
}

// /clock and a vehicle that does not move, published by the test: it may hold either, or jump.
class StillWorld {
 public:
  explicit StillWorld(double start)
      : time_(start), clock_(ros::NodeHandle().advertise<rosgraph_msgs::Clock>("/clock", 10)) {
    thread_ = std::thread([this] {
      while (!done_) {
        tick();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    });
  }
  ~StillWorld() {
    done_ = true;
    thread_.join();
  }

  void publishTf(bool on) { publishes_tf_ = on; }
  void jumpTo(double time) { time_ = time; }
  double time() const { return time_; }

 private:
  void tick() {
    time_ = time_ + 0.02;
    rosgraph_msgs::Clock clock;
    clock.clock = ros::Time(time_.load());
    clock_.publish(clock);
    if (!publishes_tf_) return;
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "map";
    transform.header.stamp = clock.clock;
    transform.child_frame_id = "base_link";
    transform.transform.rotation.w = 1.0;
    broadcaster_.sendTransform(transform);
  }

  std::atomic<double> time_;
  std::atomic<bool> publishes_tf_{true};
  std::atomic<bool> done_{false};
  ros::Publisher clock_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::thread thread_;
};

class NavigateTest : public testing::Test {
 protected:
  static constexpr int kControlRate = 200;  // Hz

  NavigateTest() {
    ros::param::del("/simulator");  // what the test before has set
    ros::param::del("/navigate_path");
  }

  void startSimulator(std::vector<std::string> arguments = {}, int real_time_factor = 8) {
    arguments.push_back("_real_time_factor:=" + std::to_string(real_time_factor));
    arguments.push_back("_update_rate:=200");
    simulator_ = std::make_unique<Process>("simulator", arguments);
    ASSERT_TRUE(odom_.waitForMoreThan(odom_.count()));
  }

  // Without a map, where the arguments do not say otherwise.
  static std::vector<std::string> fast(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"_control_rate:=" + std::to_string(kControlRate),
                                         "_tf_timeout:=3.0", "_check_map:=false"});
    return arguments;
  }

  // Until its services answer; with a path to come also until it listens to `path`.
  void startNavigate(const std::vector<std::string>& arguments = {}, bool listens = true) {
    navigate_ = std::make_unique<Process>("navigate_path", fast(arguments));
    ASSERT_TRUE(waitFor([] { return ros::service::exists("/navigate_path/cancel", false); }));
    ASSERT_TRUE(waitFor([&] { return velocity_.connected(); }));
    if (listens) {
      ASSERT_TRUE(waitFor([&] { return paths_.getNumSubscribers() > 0; }));
    }
  }

  void publishPath(const path::Path& path) {
    paths_.publish(nodes::pathToMessage(path, ros::Time::now()));
  }

  // Whether the service says that it did what was asked for.
  static bool ask(const std::string& service) {
    std_srvs::Trigger call;
    EXPECT_TRUE(ros::service::call("/navigate_path/" + service, call)) << service;
    return call.response.success;
  }

  path::Pose pose() const {
    const auto all = odom_.all();
    const geometry_msgs::Pose& at = all.back().pose.pose;
    return {{at.position.x, at.position.y, at.position.z}, nodes::yawOf(at.orientation)};
  }
  double speed() const {
    const auto all = odom_.all();
    const geometry_msgs::Vector3& v = all.back().twist.twist.linear;
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  }
  bool isAt(double x, double y) const {
    return std::hypot(pose().position.x() - x, pose().position.y() - y) < 0.1 && speed() < 0.01;
  }
  bool arrivesAt(double x, double y) {
    return waitFor([&] { return isAt(x, y); });
  }
  bool moves() {
    return waitFor([&] { return speed() > 0.3; });
  }
  bool standsStill() {
    return waitFor([&] { return speed() == 0.0; });
  }
  // Whether it stands still, and still does `seconds` of simulated time later.
  bool staysStill(double seconds = 4.0) {
    if (!standsStill()) return false;
    const ros::Time from = odom_.all().back().header.stamp;
    return odom_
               .waitFor(0,
                        [&](const nav_msgs::Odometry& o) {
                          return (o.header.stamp - from).toSec() > seconds;
                        })
               .has_value() &&
           speed() == 0.0;
  }
  bool lastCommandIsZero() {
    return waitFor([&] {
      const auto all = velocity_.all();
      return !all.empty() && isZero(all.back());
    });
  }

  ros::NodeHandle nh_;
  Latest<nav_msgs::Odometry> odom_{nh_, "odom"};
  Latest<geometry_msgs::Twist> velocity_{nh_, "cmd_vel"};
  ros::Publisher paths_ = nh_.advertise<nav_msgs::Path>("path", 1, true);
  std::unique_ptr<Process> simulator_;
  std::unique_ptr<Process> navigate_;
};

}  // namespace grid_path_planner::test
