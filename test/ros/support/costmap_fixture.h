// A real costmap_2d of a map that the test draws, and planners that pluginlib loads, for tests in a
// workspace that has these packages (doc/move_base.md).
#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>

#include <memory>
#include <pluginlib/class_loader.hpp>
#include <random>
#include <string>

#include "ros/support/wait.h"

namespace grid_path_planner::test {

inline geometry_msgs::PoseStamped stampedPose(double x, double y) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "map";
  pose.pose.position.x = x;
  pose.pose.position.y = y;
  pose.pose.orientation.w = 1.0;
  return pose;
}

// Rectangles of up to 30 cells a side in 200x200 free cells of 0.05 m.
inline nav_msgs::OccupancyGrid siteMap(std::mt19937& random) {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.info.width = map.info.height = 200;
  map.info.resolution = 0.05F;
  map.info.origin.orientation.w = 1.0;
  map.data.assign(200 * 200, 0);
  for (int obstacle = 0; obstacle < 12; ++obstacle) {
    const unsigned left = random() % 170, bottom = random() % 170;
    const unsigned width = 3 + random() % 28, height = 3 + random() % 28;
    for (unsigned row = bottom; row < bottom + height; ++row)
      for (unsigned column = left; column < left + width; ++column)
        map.data[row * 200 + column] = 100;
  }
  return map;
}

// static_layer and inflation_layer, as the launch file of the test sets them for ~costmap.
class Site {
 public:
  explicit Site(const nav_msgs::OccupancyGrid& map) {
    // Again and again: a latched map of this very process does not reach a second layer. The layer takes the first.
    publisher_ = ros::NodeHandle().advertise<nav_msgs::OccupancyGrid>("map", 1);
    const ::ros::WallTimer timer = ::ros::NodeHandle().createWallTimer(
        ::ros::WallDuration(0.1),
        [this, &map](const ::ros::WallTimerEvent&) { publisher_.publish(map); });
    geometry_msgs::TransformStamped vehicle;
    vehicle.header.frame_id = "map";
    vehicle.child_frame_id = "base_link";
    vehicle.transform.rotation.w = 1.0;
    transforms_.setUsingDedicatedThread(true);
    transforms_.setTransform(vehicle, "test", true);
    costmap_ = std::make_unique<costmap_2d::Costmap2DROS>("costmap", transforms_);
    costmap_->updateMap();
  }

  costmap_2d::Costmap2DROS& ros() { return *costmap_; }
  costmap_2d::Costmap2D& cells() { return *costmap_->getCostmap(); }
  unsigned char costAt(double x, double y) {
    unsigned int column = 0, row = 0;
    return cells().worldToMap(x, y, column, row) ? cells().getCost(column, row)
                                                 : costmap_2d::LETHAL_OBSTACLE;
  }
  // The position of a cell of cost 0.
  geometry_msgs::PoseStamped freePose(std::mt19937& random) {
    while (true) {
      const geometry_msgs::PoseStamped pose =
          stampedPose(0.05 * (random() % 200) + 0.025, 0.05 * (random() % 200) + 0.025);
      if (costAt(pose.pose.position.x, pose.pose.position.y) == costmap_2d::FREE_SPACE) return pose;
    }
  }

 private:
  ::ros::Publisher publisher_;
  tf2_ros::Buffer transforms_;
  std::unique_ptr<costmap_2d::Costmap2DROS> costmap_;
};

// Calls give(from, to, cost) for short pieces of a plan.
template <class Poses, class Give>
void forEachPiece(Site& site, const Poses& plan, Give&& give) {
  for (std::size_t i = 1; i < plan.size(); ++i) {
    const auto &a = plan[i - 1].pose.position, &b = plan[i].pose.position;
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const int pieces = 1 + static_cast<int>(length / 0.005);
    for (int piece = 0; piece < pieces; ++piece) {
      // Not in the middle, where a diagonal step goes through a corner of four cells.
      const double share = (piece + 0.37) / pieces;
      give(length / pieces, site.costAt(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)));
    }
  }
}

}  // namespace grid_path_planner::test
