// octomap_binary and octomap_full, topics and services, where the package octomap_msgs is in the
// workspace; where it is not, nothing is advertised.
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <memory>

#include "ros/mapping/mapping_thread.h"

namespace grid_path_planner::nodes {

class OctomapMessages {
 public:
  // `thread` outlives this. `on_subscriber` is called in the thread of `nh` for a new subscriber.
  // Services are served by the queue of `service_nh`.
  OctomapMessages(ros::NodeHandle nh, ros::NodeHandle service_nh, bool latch, MappingThread& thread,
                  const std::function<void()>& on_subscriber);
  ~OctomapMessages();

  // Both in the mapping thread, as octree_topic.h says.
  bool isDue(const mapping::MapModel& map) const;
  void publish(const mapping::MapModel& map, const ros::Time& stamp);
  void shutdown();

 private:
  struct Topics;
  std::unique_ptr<Topics> topics_;
};

}  // namespace grid_path_planner::nodes
