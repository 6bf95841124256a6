// A topic whose message holds all of the octree: it is built for subscribers only, and once for a map that stays as it is.
// Whoever subscribes later gets it by roscpp's latch.
//
//   OctreeTopic centres{nh.advertise<sensor_msgs::PointCloud2>("centres", 1, connected, {}, {}, true)};
//   if (centres.isDue(map)) centres.publish(centresOf(map), map);
#pragma once

#include <ros/publisher.h>

#include <cstdint>

#include "grid_path_planner/mapping/map_model.h"
#include "ros/guard/outgoing/latched_message.h"

namespace grid_path_planner::nodes {

struct OctreeTopic {
  ros::Publisher publisher;
  std::uint64_t sent_revision = 0;  // of the map; 0: none

  bool isDue(const mapping::MapModel& map) const {
    return publisher.getNumSubscribers() > 0 && sent_revision != map.revision();
  }
  template <class Message>
  void publish(const Message& message, const mapping::MapModel& map) {
    publishLatched(publisher, message);
    sent_revision = map.revision();
  }
};

}  // namespace grid_path_planner::nodes
