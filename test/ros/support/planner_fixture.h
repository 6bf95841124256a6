// A path_planner of its own for every test, and all that one talks to it with.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/GetPlan.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/PlanStatistics.h"
#include "grid_path_planner/ros/conversions.h"
#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"
#include "support/ascii_map.h"

namespace grid_path_planner::test {

const std::vector<std::string> kRoom = {"......",  //
                                        ".####.",  //
                                        "......"};

inline geometry_msgs::PoseStamped poseAt(double x, double y, double yaw = 0.0,
                                         const std::string& frame = "map") {
  geometry_msgs::PoseStamped message;
  message.header.frame_id = frame;
  path::Pose pose;
  pose.position = {x, y, 0.0};
  pose.yaw = yaw;
  message.pose = nodes::poseToMessage(pose);
  return message;
}

class PlannerTest : public testing::Test {
 protected:
  // Parameters as "_name:=value".
  void startPlanner(const std::vector<std::string>& arguments = {}) {
    if (planner_) {
      planner_.reset();
      ASSERT_TRUE(waitFor([this] { return maps_.getNumSubscribers() == 0; }));
    }
    ros::param::del("/path_planner");  // what the test before has set
    startPlanner(std::make_unique<Process>("path_planner", arguments));
  }
  void startPlanner(std::unique_ptr<Process> planner) {
    planner_ = std::move(planner);
    ASSERT_TRUE(waitFor([this] {
      return goals_.getNumSubscribers() > 0 && maps_.getNumSubscribers() > 0 &&
             updates_.getNumSubscribers() > 0 && starts_.getNumSubscribers() > 0 &&
             log_.publishers() > 1 &&  // the planner beside this process itself
             paths_.connected() && statistics_.connected() && planning_maps_.connected() &&
             ros::service::exists("/path_planner/save_waypoints", false);
    })) << "path_planner did not come up";
  }

  // Publishes a map and waits until the planner has it.
  void publishMap(const nav_msgs::OccupancyGrid& message) {
    const std::size_t seen = planning_maps_.count();
    maps_.publish(message);
    ASSERT_TRUE(planning_maps_.waitForMoreThan(seen));
  }
  void publishMap(const grid::OccupancyGrid& map, const std::string& frame = "map",
                  const ros::Time& stamp = ros::Time::now()) {
    publishMap(nodes::occupancyToMessage(map, frame, stamp));
  }
  void publishMap(const std::vector<std::string>& lines) { publishMap(AsciiMap(lines).map); }

  // Where tf has the vehicle from now on.
  void placeVehicle(double x, double y, double z = 0.0, double yaw = 0.0) {
    publishTransform("map", "base_link", x, y, z, yaw);
  }
  void publishTransform(const std::string& parent, const std::string& child, double x, double y,
                        double z, double yaw) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = parent;
    transform.header.stamp = ros::Time::now();
    transform.child_frame_id = child;
    transform.transform.translation.x = x;
    transform.transform.translation.y = y;
    transform.transform.translation.z = z;
    transform.transform.rotation.z = std::sin(yaw / 2);
    transform.transform.rotation.w = std::cos(yaw / 2);
    broadcaster_.sendTransform(transform);
  }

  void setStart(const geometry_msgs::PoseStamped& start) {
    geometry_msgs::PoseWithCovarianceStamped message;
    message.header = start.header;
    message.pose.pose = start.pose;
    starts_.publish(message);
  }

  // Sends `goal` and waits for the statistics (answer_) and the path (path_) that answer it.
  void sendGoal(const geometry_msgs::PoseStamped& goal) {
    const std::size_t seen = statistics_.count();
    const std::size_t seen_paths = paths_.count();
    goals_.publish(goal);
    waitForAnswer(seen, seen_paths);
  }
  void waitForAnswer(std::size_t seen_statistics, std::size_t seen_paths) {
    const auto path = paths_.waitForMoreThan(seen_paths);
    const auto statistics = statistics_.waitForMoreThan(seen_statistics);
    ASSERT_TRUE(path && statistics);
    path_ = *path;
    answer_ = *statistics;
  }

  // Asks ~make_plan; the statistics are in answer_, the path in path_. A start without a frame: tf.
  void makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                float tolerance = 0.0F) {
    const std::size_t seen = statistics_.count();
    nav_msgs::GetPlan call;
    call.request.start = start;
    call.request.goal = goal;
    call.request.tolerance = tolerance;
    ASSERT_TRUE(ros::service::call("/path_planner/make_plan", call));
    const auto statistics = statistics_.waitForMoreThan(seen);
    ASSERT_TRUE(statistics);
    answer_ = *statistics;
    path_ = call.response.plan;
  }

  // Places the vehicle and waits until the planner sees it there. The map must be passable there.
  void placeVehicleAndWait(double x, double y, double z = 0.0) {
    placeVehicle(x, y, z);
    ASSERT_TRUE(waitFor([&] {
      makePlan({}, poseAt(x, y));
      return answer_.status == "FOUND" && endsAt(path_.poses.front(), x, y);
    }));
  }

  static bool endsAt(const geometry_msgs::PoseStamped& pose, double x, double y) {
    return std::hypot(pose.pose.position.x - x, pose.pose.position.y - y) < 1e-6;
  }
  static void expectStampedAndEmpty(const nav_msgs::Path& path, const std::string& frame = "map") {
    EXPECT_TRUE(path.poses.empty());
    EXPECT_EQ(path.header.frame_id, frame);
    EXPECT_FALSE(path.header.stamp.isZero());
  }
  // Whether the path passes within `distance` metres of a point, at its poses.
  static bool passes(const nav_msgs::Path& path, double x, double y, double distance) {
    for (const auto& pose : path.poses)
      if (std::hypot(pose.pose.position.x - x, pose.pose.position.y - y) <= distance) return true;
    return false;
  }

  ros::NodeHandle nh_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  ros::Publisher goals_ = nh_.advertise<geometry_msgs::PoseStamped>("goal", 10);
  ros::Publisher maps_ = nh_.advertise<nav_msgs::OccupancyGrid>("projected_map", 10);
  ros::Publisher updates_ =
      nh_.advertise<map_msgs::OccupancyGridUpdate>("projected_map_updates", 10);
  ros::Publisher starts_ =
      nh_.advertise<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 10);
  Latest<rosgraph_msgs::Log> log_{nh_, "/rosout"};
  Latest<nav_msgs::Path> paths_{nh_, "path"};
  Latest<PlanStatistics> statistics_{nh_, "plan_statistics"};
  Latest<nav_msgs::OccupancyGrid> planning_maps_{nh_, "planning_map"};
  std::unique_ptr<Process> planner_;
  PlanStatistics answer_;
  nav_msgs::Path path_;
};

}  // namespace grid_path_planner::test
