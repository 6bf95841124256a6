// Two vehicles under one master: each plans and drives in its own namespace and moves its own frames; a goal of
// one is none of the other's.
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <std_msgs/UInt32.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <set>
#include <string>

#include "ros/support/latest.h"

namespace grid_path_planner::nodes {
namespace {

using test::Latest;

struct Vehicle {
  explicit Vehicle(const std::string& name)
      : frame(name + "/base_link"),
        paths({}, "/" + name + "/path"),
        odometry({}, "/" + name + "/odom"),
        contacts({}, "/" + name + "/contacts"),
        goals(ros::NodeHandle().advertise<geometry_msgs::PoseStamped>(
            "/" + name + "/move_base_simple/goal", 1)) {}

  bool at(double x, double y) const {
    const auto all = odometry.all();
    if (all.empty()) return false;
    const auto& position = all.back().pose.pose.position;
    return std::hypot(position.x - x, position.y - y) < 0.2;
  }
  bool ready() const {
    return goals.getNumSubscribers() == 1 && paths.connected() && odometry.count() > 0;
  }
  // Until there is a path to it, since the planner waits for the map and for tf.
  bool goTo(double x, double y) {
    geometry_msgs::PoseStamped goal;
    goal.header.frame_id = "map";
    goal.pose.position.x = x;
    goal.pose.position.y = y;
    goal.pose.orientation.w = 1.0;
    goals.publish(goal);
    auto next = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    return test::waitFor([&] {
      if (std::chrono::steady_clock::now() > next) {
        goals.publish(goal);
        next += std::chrono::seconds(2);
      }
      return paths.waitingFor(x, y);
    });
  }

  struct Paths : Latest<nav_msgs::Path> {
    using Latest::Latest;
    bool waitingFor(double x, double y) const {
      const auto all = this->all();
      if (all.empty() || all.back().poses.empty()) return false;
      const auto& end = all.back().poses.back().pose.position;
      return std::hypot(end.x - x, end.y - y) < 0.01;
    }
  };

  std::string frame;
  Paths paths;
  Latest<nav_msgs::Odometry> odometry;
  Latest<std_msgs::UInt32> contacts;
  ros::Publisher goals;
};

TEST(TwoVehicles, EachDrivesToItsOwnGoal) {
  Vehicle a("a"), b("b");
  ASSERT_TRUE(test::waitFor([&] { return a.ready() && b.ready(); }));
  ASSERT_TRUE(test::waitFor([&] { return a.at(3.0, 3.0) && b.at(60.0, 4.0); }));

  ASSERT_TRUE(a.goTo(5.0, 3.5));
  EXPECT_TRUE(test::waitFor([&] { return a.at(5.0, 3.5); }));
  EXPECT_TRUE(b.at(60.0, 4.0)) << "nobody sent it anywhere";
  EXPECT_EQ(b.paths.count(), 0u);

  ASSERT_TRUE(b.goTo(58.0, 4.5));
  EXPECT_TRUE(test::waitFor([&] { return b.at(58.0, 4.5); }));
  EXPECT_TRUE(a.at(5.0, 3.5)) << "it has arrived";
  for (const Vehicle* vehicle : {&a, &b})
    for (const std_msgs::UInt32& contacts : vehicle->contacts.all()) EXPECT_EQ(contacts.data, 0u);
}

TEST(TwoVehicles, EachMovesItsOwnFramesOnly) {
  Latest<tf2_msgs::TFMessage> transforms({}, "/tf");
  std::set<std::string> children;
  ASSERT_TRUE(test::waitFor([&] {
    for (const auto& message : transforms.all())
      for (const auto& each : message.transforms) children.insert(each.child_frame_id);
    return children.count("a/base_link") > 0 && children.count("b/base_link") > 0;
  }));
  for (const std::string& frame : children)
    EXPECT_TRUE(frame.rfind("a/", 0) == 0 || frame.rfind("b/", 0) == 0) << frame;
}

// What is outside both namespaces is shared by right: time, tf, logs, diagnostics, and the one map.
TEST(TwoVehicles, NothingElseIsShared) {
  const std::set<std::string> shared = {
      "/tf",          "/tf_static",   "/clock",         "/rosout",
      "/rosout_agg",  "/diagnostics", "/projected_map", "/projected_map_updates",
      "/map_metadata"};
  ros::master::V_TopicInfo topics;
  ASSERT_TRUE(ros::master::getTopics(topics));
  for (const auto& topic : topics) {
    const bool of_one = topic.name.rfind("/a/", 0) == 0 || topic.name.rfind("/b/", 0) == 0;
    const bool of_map =
        topic.name.rfind("/map_publisher", 0) == 0 || topic.name.rfind("/map_file", 0) == 0;
    EXPECT_TRUE(of_one || of_map || shared.count(topic.name) > 0) << topic.name;
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
