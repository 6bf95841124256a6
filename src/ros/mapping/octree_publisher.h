// The topics of the octree: occupied_cells_vis_array, free_cells_vis_array,
// octomap_point_cloud_centers, and octomap_binary and octomap_full where there is octomap_msgs.
//
// These messages hold the whole tree, so their cost grows with the map. They are built as octree_topic.h says,
// and take at most a fifth of the time: after a publication that took t seconds there is none for 4 t.
#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "grid_path_planner/mapping/map_model.h"
#include "ros/mapping/mapping_thread.h"
#include "ros/mapping/octomap_messages.h"
#include "ros/mapping/octree_topic.h"

namespace grid_path_planner::nodes {

class OctreePublisher {
 public:
  // `thread` outlives this. `on_subscriber` is called in the thread of `nh` for a new subscriber;
  // services are served by the queue of `service_nh`.
  OctreePublisher(ros::NodeHandle nh, ros::NodeHandle service_nh, bool latch, MappingThread& thread,
                  const std::function<void()>& on_subscriber);

  // Publishes the topics that have subscribers, if they are due. In the mapping thread.
  void publish(const mapping::MapModel& map, const ros::Time& stamp);
  void shutdown() { messages_->shutdown(); }
  // How often messages have been built. Thread-safe.
  std::uint64_t builds() const { return builds_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool isDue(const mapping::MapModel& map) const;
  bool isFreeDue(const mapping::MapModel& map) const;
  void send(const mapping::MapModel& map, const ros::Time& stamp);
  void sendMarkers(const mapping::MapModel& map, const ros::Time& stamp);

  std::atomic<std::uint64_t> builds_{0};
  Clock::time_point not_before_;
  OctreeTopic occupied_, free_, centres_;
  std::unique_ptr<OctomapMessages> messages_;
};

}  // namespace grid_path_planner::nodes
