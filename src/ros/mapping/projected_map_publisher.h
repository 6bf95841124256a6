// projected_map and projected_map_updates: whole maps where they are needed, else what changed.
//
// A whole map goes out when the geometry changed, when somebody new listens (unless ~latch is off
// and every change sends a whole map anyway), and with always_send_full_map on every change. Else
// an update carries the smallest rectangle around the changed cells. Without subscribers nothing is
// projected: the changes wait in the tree.
//
// Not guaranteed: a fresh map for a second subscriber inside of one process. roscpp gives it the
// whole map that came last, and does not tell us of it; with updates that one may be old.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <atomic>
#include <functional>

#include "grid_path_planner/mapping/map_model.h"

namespace grid_path_planner::nodes {

class ProjectedMapPublisher {
 public:
  // `on_subscriber` is called in the thread of `nh` when somebody new listens to the map.
  ProjectedMapPublisher(ros::NodeHandle nh, bool latch, std::function<void()> on_subscriber);

  // Publishes what changed since the last call, if anybody listens. In the map's thread.
  void publish(mapping::MapModel& map, const ros::Time& stamp);

 private:
  bool heard() const;

  std::atomic<bool> someone_new_{false};
  bool sent_ = false;  // a whole map
  ros::Publisher map_publisher_;
  ros::Publisher update_publisher_;
};

}  // namespace grid_path_planner::nodes
