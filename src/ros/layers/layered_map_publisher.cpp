#include "ros/layers/layered_map_publisher.h"

#include <utility>

#include "grid_path_planner/ros/occupancy_conversion.h"
#include "ros/guard/outgoing/latched_message.h"

namespace grid_path_planner::nodes {

using grid::CellRect;
using layers::LayeredMap;

LayeredMapPublisher::LayeredMapPublisher(ros::NodeHandle nh)
    : topic_(nh, "projected_map", true, [] {}),  // who is new waits for the next publish()
      speed_limits_(nh.advertise<nav_msgs::OccupancyGrid>("speed_limit", 1, true)) {}

void LayeredMapPublisher::publish(LayeredMap& map, const std::string& frame_id,
                                  const ros::Time& newest, double full_map_period) {
  owes_limits_ = map.takeNewSpeedLimits() || owes_limits_;
  if (owes_limits_)
    publishLatched(speed_limits_,
                   occupancyToMessage(map.speedLimits(), frame_id, ros::Time::now()));
  owes_limits_ = false;
  if (topic_.hasSubscribers())
    publishMap(map, frame_id, newest, full_map_period);
  else
    withdraw();
}

void LayeredMapPublisher::publishMap(LayeredMap& map, const std::string& frame_id,
                                     const ros::Time& newest, double full_map_period) {
  const bool owed = !std::exchange(sent_, false);  // true, too, where an error ended the last
  const bool new_geometry = map.takeNewGeometry();
  const std::vector<CellRect> changed = map.takeChanged();
  const bool whole = topic_.takeNewSubscriber() || new_geometry || owed ||
                     topic_.wholeMapIsDue(full_map_period) ||
                     (!changed.empty() && topic_.needsWholeMaps());
  if (whole || !changed.empty()) {
    const ros::Time stamp = topic_.stampFor(newest, ros::Time::now());
    if (whole)
      topic_.send(occupancyToMessage(map.merged(), frame_id, stamp));
    else
      for (const CellRect& rect : updateRects(changed))
        topic_.send(updateOf(map.merged(), rect, frame_id, stamp));
  }
  sent_ = true;
}

void LayeredMapPublisher::publishHeartbeat(const std::string& frame_id, const ros::Time& newest) {
  if (sent_) topic_.sendHeartbeat(updateOf({}, frame_id, newest));
}

void LayeredMapPublisher::withdraw() {
  sent_ = false;
  topic_.forget();
}

}  // namespace grid_path_planner::nodes
