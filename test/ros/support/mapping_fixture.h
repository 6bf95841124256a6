// A projected_map of its own for every test, clouds for it, and what it makes of them.
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_ros/transform_broadcaster.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/support/latest.h"
#include "ros/support/process.h"

namespace grid_path_planner::test {

using CloudPoints = std::vector<Eigen::Vector3f>;

inline sensor_msgs::PointCloud2 cloudOf(const CloudPoints& points, const std::string& frame,
                                        const ros::Time& stamp) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = frame;
  cloud.header.stamp = stamp;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(points.size());
  if (points.empty()) return cloud;  // an iterator asks for the first byte
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x");
  for (const Eigen::Vector3f& point : points) {
    x[0] = point.x();
    x[1] = point.y();
    x[2] = point.z();
    ++x;
  }
  return cloud;
}

// A wall across x at `x` m, from y = -1 to 1 m and from z = `low` to `high` m, a point every 5 cm.
inline CloudPoints wallAt(float x, float low = -0.45F, float high = 0.45F) {
  CloudPoints points;
  for (float y = -0.975F; y < 1.0F; y += 0.05F)
    for (float z = low; z < high; z += 0.05F) points.emplace_back(x, y, z);
  return points;
}

// 100 occupied, 0 free, -1 unknown or outside.
inline int valueAt(const nav_msgs::OccupancyGrid& map, double x, double y) {
  const grid::OccupancyGrid grid = nodes::occupancyFromMessage(map);
  const auto cell = grid.geometry().cellAt({x, y});
  return cell ? grid[*cell] : -1;
}

class MappingTest : public testing::Test {
 protected:
  // Parameters as "_name:=value". The map's frame is map, its resolution 0.1 m.
  void startMapping(std::vector<std::string> arguments = {}) {
    if (node_) {
      node_.reset();
      ASSERT_TRUE(waitFor([this] { return clouds_.getNumSubscribers() == 0; }));
    }
    ros::param::del("/projected_map");  // what was set before
    arguments.insert(arguments.begin(),
                     {"_resolution:=0.1", "_publish_rate:=50", "_diagnostic_period:=0.1",
                      "_heartbeat_period:=0", "_autosave_period:=0"});
    node_ = std::make_unique<Process>("projected_map", arguments);
    ASSERT_TRUE(waitFor([this] {
      return clouds_.getNumSubscribers() > 0 &&
             ros::service::exists("/projected_map/save_octree", false) &&
             ros::service::exists("/projected_map/set_parameters", false);
    })) << "projected_map did not come up";
  }

  void placeSensor(double x, double y, double z, const std::string& frame = "sensor",
                   const ros::Time& stamp = ros::Time::now()) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "map";
    transform.header.stamp = stamp;
    transform.child_frame_id = frame;
    transform.transform.translation.x = x;
    transform.transform.translation.y = y;
    transform.transform.translation.z = z;
    transform.transform.rotation.w = 1.0;
    broadcaster_.sendTransform(transform);
  }

  // A cloud in the map's own frame, with the sensor at its origin.
  void publish(const CloudPoints& points) {
    clouds_.publish(cloudOf(points, "map", ros::Time::now()));
  }

  // What the diagnostics say under `key`, of the clouds or of the map; "" before they do.
  std::string reported(const std::string& key, const std::string& about = "clouds") const {
    std::string value;
    for (const auto& array : diagnostics_.all())
      for (const auto& status : array.status)
        for (const auto& entry : status.values)
          if (status.name == "projected_map: " + about && entry.key == key) value = entry.value;
    return value;
  }
  bool reports(const std::string& key, const std::string& value,
               const std::string& about = "clouds") const {
    return waitFor([&] { return reported(key, about) == value; });
  }

  using Maps = Latest<nav_msgs::OccupancyGrid>;
  static bool becomes(const Maps& maps, double x, double y, int value) {
    return maps
        .waitFor(0, [&](const nav_msgs::OccupancyGrid& map) { return valueAt(map, x, y) == value; })
        .has_value();
  }

  ros::NodeHandle nh_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher clouds_ = nh_.advertise<sensor_msgs::PointCloud2>("cloud_in", 100);
  Latest<diagnostic_msgs::DiagnosticArray> diagnostics_{nh_, "/diagnostics"};
  std::unique_ptr<Process> node_;
};

}  // namespace grid_path_planner::test
