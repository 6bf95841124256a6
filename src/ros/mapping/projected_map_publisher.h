// projected_map and projected_map_updates: whole maps where they are needed, else the changed cells.
//
// A whole map is published when the geometry changed, for a new subscriber (unless ~latch is off and
// every change publishes a whole map anyway), and with always_send_full_map on every change.
// Otherwise an update holds the smallest rectangle around the changed cells. Without subscribers
// nothing is projected: the changes wait in the tree.
//
// Not guaranteed: a current map for a second subscriber inside of one process. roscpp gives it the
// last whole map without a callback; with updates that map may be out of date.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <atomic>
#include <functional>

#include "grid_path_planner/mapping/map_model.h"

namespace grid_path_planner::nodes {

class ProjectedMapPublisher {
 public:
  // `on_subscriber` is called in the thread of `nh` for a new subscriber of the map.
  ProjectedMapPublisher(ros::NodeHandle nh, bool latch, std::function<void()> on_subscriber);

  // Publishes the changes since the last call, if there are subscribers. In the mapping thread.
  void publish(mapping::MapModel& map, const ros::Time& stamp);

 private:
  bool hasSubscribers() const;

  std::atomic<bool> new_subscriber_{false};
  bool sent_ = false;  // a whole map
  ros::Publisher map_publisher_;
  ros::Publisher update_publisher_;
};

}  // namespace grid_path_planner::nodes
