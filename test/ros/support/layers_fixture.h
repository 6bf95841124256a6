// A map_layers, and all that it hears, for rostests.
#pragma once

#include <gtest/gtest.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/map_listeners.h"
#include "ros/support/process.h"
#include "support/ascii_map.h"

namespace grid_path_planner::test {

const std::vector<std::string> kOpenRoom(12, "............");

class LayersTest : public testing::Test {
 protected:
  LayersTest() { ros::param::del("/map_layers"); }

  void start(const std::vector<std::string>& arguments) {
    node_ = std::make_unique<Process>("map_layers", arguments);
    ASSERT_TRUE(waitFor([&] { return copy_.connected() && beats_.connected(); }));
  }
  void publishStatic(const std::vector<std::string>& lines, const grid::Origin& origin = {},
                     const std::string& frame = "map") {
    static_.publish(
        nodes::occupancyToMessage(AsciiMap(lines, 1.0, origin).map, frame, ros::Time::now()));
  }
  void placeLaser() {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = "map";
    transform.child_frame_id = "laser";
    transform.transform.translation.x = 0.5;
    transform.transform.translation.y = 0.5;
    transform.transform.rotation.w = 1.0;
    broadcaster_.sendTransform(transform);
  }
  // A ray along the x axis.
  void see(float range, const ros::Time& stamp = ros::Time::now()) {
    sensor_msgs::LaserScan scan;
    scan.header.frame_id = "laser";
    scan.header.stamp = stamp;
    scan.range_max = 30.0F;
    scan.ranges = {range};
    scans_.publish(scan);
  }
  int at(int column, int row) const {
    return copy_.maps() == 0 ? -2 : copy_.grid()[grid::Cell{column, row}];
  }
  bool becomes(int column, int row, int value) const {
    return waitFor([&] { return at(column, row) == value; });
  }
  // While scans of that range come.
  bool becomesBySeeing(float range, int column, int row, int value) {
    return waitFor([&] {
      see(range);
      return at(column, row) == value;
    });
  }
  std::size_t beats() const {
    std::size_t count = 0;
    for (const auto& update : beats_.all()) count += update.width == 0 ? 1 : 0;
    return count;
  }

  ros::NodeHandle nh_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  ros::Publisher static_ = nh_.advertise<nav_msgs::OccupancyGrid>("static_map", 1, true);
  ros::Publisher live_ = nh_.advertise<nav_msgs::OccupancyGrid>("live_map", 1, true);
  ros::Publisher live_updates_ =
      nh_.advertise<map_msgs::OccupancyGridUpdate>("live_map_updates", 10);
  ros::Publisher mask_ = nh_.advertise<nav_msgs::OccupancyGrid>("keep_out_mask", 1, true);
  ros::Publisher scans_ = nh_.advertise<sensor_msgs::LaserScan>("scan", 10);
  MapCopy copy_{nh_, "projected_map"};
  Latest<map_msgs::OccupancyGridUpdate> beats_{nh_, "projected_map_updates"};
  Latest<nav_msgs::OccupancyGrid> limits_{nh_, "speed_limit"};
  std::unique_ptr<Process> node_;
};

}  // namespace grid_path_planner::test
