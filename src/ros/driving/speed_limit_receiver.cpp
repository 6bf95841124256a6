#include "ros/driving/speed_limit_receiver.h"

#include <ros/console.h>

#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/incoming/claimed_lengths.h"

namespace grid_path_planner::nodes {

SpeedLimitReceiver::SpeedLimitReceiver(ros::NodeHandle nh, Listener listener)
    : listener_(std::move(listener)),
      subscriber_(subscribeChecked<nav_msgs::OccupancyGrid, const MapEvent&>(
          nh, "speed_limit", 1, [this](const MapEvent& event) { onMap(event); })) {}

void SpeedLimitReceiver::onMap(const MapEvent& event) {
  if (isNotYet(event)) return;
  const nav_msgs::OccupancyGrid& message = *event.getConstMessage();
  try {
    const auto grid = std::make_shared<grid::OccupancyGrid>(occupancyFromMessage(message));
    tellTraits(event);
    listener_({grid, frameName(message.header.frame_id)});
    state_ = "a map of speed limits is heeded";
  } catch (const base::InputError& error) {
    state_ = std::string("the last map was refused, the one before stays: ") + error.what();
    ROS_ERROR_STREAM("A map on " << subscriber_.getTopic() << " is refused: " << error.what());
  }
}

}  // namespace grid_path_planner::nodes
