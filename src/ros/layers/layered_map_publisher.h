// projected_map and projected_map_updates of map_layers, its heartbeat, and speed_limit.
//
// A whole map is sent for a new subscriber, when the geometry changed, on every change for a subscriber that does not
// take the updates, after a time without a map, and full_map_period after an update; else what changed. Without
// subscribers nothing is sent or latched. Maps and updates are stamped as MapTopic::stampFor has it. speed_limit is latched and sent whole when it changes.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "layers/layered_map.h"
#include "ros/messages/map_topic.h"

namespace grid_path_planner::nodes {

class LayeredMapPublisher {
 public:
  explicit LayeredMapPublisher(ros::NodeHandle nh);

  // What changed since the last call, and what new subscribers need; `newest`: up to when the map holds what all sensors saw,
  // 0 without one.
  void publish(layers::LayeredMap& map, const std::string& frame_id, const ros::Time& newest,
               double full_map_period);
  // Stamped `newest`, if a map was sent that still holds.
  void publishHeartbeat(const std::string& frame_id, const ros::Time& newest);
  // There is no map now: who subscribes later gets none.
  void withdraw();

 private:
  void publishMap(layers::LayeredMap& map, const std::string& frame_id, const ros::Time& newest,
                  double full_map_period);

  MapTopic topic_;
  ros::Publisher speed_limits_;
  bool owes_limits_ = false;  // they were taken from the map and not sent
  bool sent_ = false;         // a map that still holds
};

}  // namespace grid_path_planner::nodes
