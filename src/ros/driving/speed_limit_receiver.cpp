#include "ros/driving/speed_limit_receiver.h"

#include <ros/console.h>

#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/driving/map_liveness.h"
#include "ros/guard/incoming/claimed_lengths.h"

namespace grid_path_planner::nodes {

SpeedLimitReceiver::SpeedLimitReceiver(ros::NodeHandle nh, Listener listener)
    : listener_(std::move(listener)),
      subscriber_(subscribeChecked<nav_msgs::OccupancyGrid, const MapEvent&>(
          nh, "speed_limit", 1, [this](const MapEvent& event) { onMap(event); })) {}

SpeedLimitReceiver::~SpeedLimitReceiver() {
  subscriber_.shutdown();
}

void SpeedLimitReceiver::onMap(const MapEvent& event) {
  if (isNotYet(event)) return;
  const nav_msgs::OccupancyGrid& message = *event.getConstMessage();
  try {
    const auto grid = std::make_shared<grid::OccupancyGrid>(occupancyFromMessage(message));
    tellTraits(event);
    use({grid, frameName(message.header.frame_id), subscriber_.getTopic(), event.getPublisherName(),
         std::chrono::steady_clock::now()});
    state_ = "a map of speed limits is heeded";
  } catch (const base::InputError& error) {
    state_ = std::string("the last map was refused, the one before stays: ") + error.what();
    ROS_ERROR_STREAM("A map on " << subscriber_.getTopic() << " is refused: " << error.what());
  }
}

void SpeedLimitReceiver::use(SpeedLimits limits) {
  const std::lock_guard<std::mutex> lock(mutex_);
  limits_ = std::move(limits);
  listener_(limits_);
}

std::string SpeedLimitReceiver::publisher() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return limits_.publisher;
}

void SpeedLimitReceiver::onAnswer(const std::string& node) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (limits_.publisher != node) return;
  limits_.last_heard = std::chrono::steady_clock::now();
  listener_(limits_);
}

std::string whyNoLimits(const SpeedLimits& limits) {
  if (!limits.grid) return "";
  const double silence = base::secondsSince(limits.last_heard);
  if (silence <= kPublisherTimeout) return "";
  return "the map of speed limits on " + limits.topic + " is not kept up: " + limits.publisher +
         " has not answered for " + silenceText(silence);
}

}  // namespace grid_path_planner::nodes
