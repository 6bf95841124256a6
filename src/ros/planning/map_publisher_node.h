// The node map_publisher: publishes a map file, latched.
//
//   publishes  projected_map (~topic)  nav_msgs/OccupancyGrid
//              map_metadata            nav_msgs/MapMetaData
//   services   static_map              nav_msgs/GetMap
//
// The file is read at the start, and again when dynamic_reconfigure changes ~filename. A file that
// cannot be read ends the node at the start, and leaves the map as it is later. Nothing is published
// before there is a ROS time for the stamp.
#pragma once

#include <nav_msgs/GetMap.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <ros/steady_timer.h>

#include <memory>
#include <string>

#include "grid_path_planner/grid/occupancy.h"
#include "ros/guard/node_files.h"
#include "ros/planning/map_publisher_options.h"

namespace grid_path_planner {
class MapPublisherConfig;
}  // namespace grid_path_planner

namespace grid_path_planner::None {}  // namespace grid_path_planner::None

namespace grid_path_planner::nodes {

template <class Config, class Options>
class Reconfigurable;

class MapPublisherNode {
 public:
  // A file by argument replaces the parameter, as on the command line of map_server; others lie below
  // the folder to load from. Throws InputError for parameters and files that cannot be used.
  MapPublisherNode(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const NodeFiles& files = {});
  ~MapPublisherNode();

 private:
  grid::OccupancyGrid readMap(const MapPublisherOptions& wanted) const;
  void use(const MapPublisherOptions& options);
  void publishOnceThereIsTime();
  bool getMap(nav_msgs::GetMap::Response& response);

  NodeFiles files_;
  MapPublisherOptions options_;
  grid::OccupancyGrid map_;
  nav_msgs::OccupancyGrid message_;  // stamp 0 until it is published
  ros::NodeHandle nh_;
  ros::Publisher map_publisher_;
  ros::Publisher metadata_publisher_;
  ros::ServiceServer service_;
  ros::SteadyTimer timer_;
  std::unique_ptr<Reconfigurable<MapPublisherConfig, MapPublisherOptions>> reconfigurable_;
};

}  // namespace grid_path_planner::nodes
