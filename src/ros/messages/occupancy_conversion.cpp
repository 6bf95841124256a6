#include "grid_path_planner/ros/occupancy_conversion.h"

#include <cmath>
#include <limits>

#include "grid/float_decimal.h"
#include "grid_path_planner/base/level_quaternion.h"
#include "ros/guard/network_text.h"

namespace grid_path_planner::nodes {

using base::InputError;
using base::yawOfMapOrigin;
using grid::checkOccupancyValues;
using grid::floatToDecimal;
using grid::GridGeometry;
using grid::OccupancyGrid;

std::string frameName(const std::string& frame_id) {
  checkNetworkText("the name of a frame", frame_id);
  return !frame_id.empty() && frame_id.front() == '/' ? frame_id.substr(1) : frame_id;
}

std::string frameInMap(const std::string& frame_id, const std::string& map_frame) {
  const std::string name = frameName(frame_id);
  return name.empty() ? frameName(map_frame) : name;
}

bool hasNoOrientation(const nav_msgs::MapMetaData& info) {
  const auto& of = info.origin.orientation;
  return base::isZeroQuaternion(of.x, of.y, of.z, of.w);
}

GridGeometry geometryFromMessage(const nav_msgs::MapMetaData& info) {
  constexpr std::uint32_t kMost = std::numeric_limits<int>::max();
  if (info.width > kMost || info.height > kMost)
    throw InputError("a map of " + std::to_string(info.width) + "x" + std::to_string(info.height) +
                     " cells is too large");
  const auto& position = info.origin.position;
  const auto& orientation = info.origin.orientation;
  const double yaw = yawOfMapOrigin(orientation.x, orientation.y, orientation.z, orientation.w);
  return GridGeometry(static_cast<int>(info.width), static_cast<int>(info.height),
                      floatToDecimal(info.resolution), {position.x, position.y, yaw});
}

nav_msgs::MapMetaData geometryToMessage(const GridGeometry& geometry, const ros::Time& load_time) {
  nav_msgs::MapMetaData info;
  info.map_load_time = load_time;
  info.resolution = static_cast<float>(geometry.resolution());
  info.width = static_cast<std::uint32_t>(geometry.width());
  info.height = static_cast<std::uint32_t>(geometry.height());
  info.origin.position.x = geometry.origin().x;
  info.origin.position.y = geometry.origin().y;
  info.origin.orientation.z = std::sin(geometry.origin().yaw / 2.0);
  info.origin.orientation.w = std::cos(geometry.origin().yaw / 2.0);
  return info;
}

bool isEmptyMap(const nav_msgs::OccupancyGrid& message) {
  return message.data.empty() && (message.info.width == 0 || message.info.height == 0);
}

OccupancyGrid occupancyFromMessage(const nav_msgs::OccupancyGrid& message) {
  OccupancyGrid map(geometryFromMessage(message.info), message.data);
  checkOccupancyValues(map);
  return map;
}

nav_msgs::OccupancyGrid occupancyToMessage(const OccupancyGrid& map, const std::string& frame_id,
                                           const ros::Time& stamp) {
  nav_msgs::OccupancyGrid message;
  message.header.frame_id = frame_id;
  message.header.stamp = stamp;
  message.info = geometryToMessage(map.geometry(), stamp);
  message.data = map.values();
  return message;
}

}  // namespace grid_path_planner::nodes
