// nav_msgs/OccupancyGrid to the package's own map and back.
//
//   const OccupancyGrid map = occupancyFromMessage(*message);
//   const std::string frame = frameName(message->header.frame_id);       // "/map" is "map"
//   publisher.publish(occupancyToMessage(map, frame, ros::Time::now()));
//
// Map -> message -> map is the identity for resolutions of up to six decimal digits (a message
// holds a float32), and for the origin's yaw to within rounding (a message holds a quaternion). The
// origin's z is not kept.
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/time.h>

#include <string>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::nodes {

// The name of a frame as tf2 wants it: a leading slash is dropped. All names from messages and
// parameters come through here. Throws InputError for text that a shell, a terminal or a file would
// take for more than a name: quotes, $, `, \, control characters, more than 256 bytes.
std::string frameName(const std::string& frame_id);

// The frame of a message that says where in the map something is: a map, a goal, a path, points, a fix. That of its
// header; `map_frame`, the node's parameter, where it names none. Not for what a sensor measured: without a frame nobody
// knows where the sensor was. Throws as frameName does.
std::string frameInMap(const std::string& frame_id, const std::string& map_frame);

// Whether the orientation of its origin is of zeros, as octomap_server's: it is taken for yaw 0.
bool hasNoOrientation(const nav_msgs::MapMetaData& info);
// The geometry that a message describes, without its cells. Throws
// InputError for what GridGeometry refuses and for an origin that is not level.
grid::GridGeometry geometryFromMessage(const nav_msgs::MapMetaData& info);
// The origin's z is 0.
nav_msgs::MapMetaData geometryToMessage(const grid::GridGeometry& geometry,
                                        const ros::Time& load_time);

// Whether it has no cells, as what octomap_server sends before it has seen anything, without a frame: no map yet, which
// occupancyFromMessage refuses.
bool isEmptyMap(const nav_msgs::OccupancyGrid& message);

// Throws InputError for a message that is no map: no cells, a number of values other than width x
// height, a value outside -1..100, a resolution that is not positive and finite, an origin that is
// not finite or not level.
grid::OccupancyGrid occupancyFromMessage(const nav_msgs::OccupancyGrid& message);

// A message of `map`, stamped and with map_load_time `stamp`. The origin's z is 0.
nav_msgs::OccupancyGrid occupancyToMessage(const grid::OccupancyGrid& map,
                                           const std::string& frame_id, const ros::Time& stamp);

}  // namespace grid_path_planner::nodes
