// projected_map and projected_map_updates: whole maps where they are needed, else the changed cells.
//
// A whole map is published when the geometry changed, for a new subscriber (unless ~latch is off and
// every change publishes a whole map anyway), for a new subscriber of the updates, on every change
// for a subscriber that does not take the updates or with always_send_full_map, and full_map_period
// after the last one if there was an update since.
// Otherwise an update holds the smallest rectangle around the changed cells. Without subscribers
// nothing is projected: the changes wait in the tree.
//
// Maps and updates are stamped with the newest cloud in them (MapTopic::stampFor); before the first, when they are sent.
//
// A heartbeat is an update of 0x0 cells. It tells receivers that the mapping lives and up to when
// the map holds what was seen: its stamp is that of the newest cloud in the map as published, also where that
// changed nothing; 0 before the first. While a map cannot be made or sent there is none, so that a driver holds: the map that it has
// lacks what was seen since.
//
// Not guaranteed: a current map for a second subscriber inside of one process. roscpp gives it the
// last whole map without a callback; with updates that map may be out of date.
#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <functional>
#include <string>

#include "grid_path_planner/mapping/map_model.h"
#include "ros/messages/map_topic.h"

namespace grid_path_planner::nodes {

class ProjectedMapPublisher {
 public:
  // `on_subscriber` is called in the thread of `nh` for a new subscriber of the map.
  ProjectedMapPublisher(ros::NodeHandle nh, bool latch, std::function<void()> on_subscriber);

  // Publishes the changes since the last call, if there are subscribers. In the mapping thread.
  void publish(mapping::MapModel& map, const ros::Time& now);
  // While the map cannot be made: the next one that is sent is whole. In the mapping thread.
  void owe();
  // Since owe(). Thread-safe.
  bool owesMap() const { return owes_map_; }

  // A cloud of this stamp is in the tree. Stamps of clouds may be any number: what lies after `now`
  // counts as `now`, as does what was counted before ROS time jumped back. In the mapping thread.
  void countCloud(const ros::Time& stamp, const ros::Time& now);
  // Of the clouds counted. In the mapping thread.
  const ros::Time& newestCloud() const { return newest_cloud_; }
  // None while a map is owed. In the mapping thread.
  void publishHeartbeat(const std::string& frame_id);

 private:
  bool wholeMapIsWanted(const mapping::ProjectionChange& change,
                        const mapping::ProjectedMapOptions& options);
  void send(mapping::MapModel& map, const ros::Time& now, bool whole);
  // Once.
  void warnOfFloor(const grid::OccupancyGrid& grid, const mapping::ProjectedMapOptions& options);

  bool sent_ = false;                  // a whole map
  std::atomic<bool> owes_map_{false};  // a whole one, since what was to be sent last was not
  bool torn_ = false;                  // changes were taken from the map and not sent
  bool warned_of_floor_ = false;
  ros::Time newest_cloud_;            // in the tree
  ros::Time newest_published_cloud_;  // in the map as it was published last
  MapTopic topic_;
};

}  // namespace grid_path_planner::nodes
