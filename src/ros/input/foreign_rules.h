// What other programs' messages mean where they are wrong by the letter and can mean one thing only: taken as the field
// takes it, and told once a publisher. The rules are here; no node has its own.
//
//   if (isNotYet(event)) return;
//   use(occupancyFromMessage(*event.getConstMessage()));
//   tellTraits(event);
//
// What the core reads of files too is in base/ (level_quaternion.h); there the reader's caller is told.
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <ros/message_event.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "grid/foreign_values.h"
#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::nodes {

using MapEvent = ros::MessageEvent<nav_msgs::OccupancyGrid const>;

// Which things were told. Thread-safe; of more than kMost it forgets that they were.
class ToldOnce {
 public:
  static constexpr std::size_t kMost = 1000;

  // Whether `thing` was not told before; then it counts as told.
  bool isNew(const std::string& thing);

 private:
  std::mutex mutex_;
  std::set<std::string> told_;
};

void warnOnce(const std::string& topic, const std::string& publisher, const std::string& trait);
// As the publisher names it; empty where it does not.
std::string topicOf(const boost::shared_ptr<ros::M_string>& connection_header);

// Warns in the log, once in this process for each publisher and topic: "/projected_map of /octomap_server: `trait`".
template <class Message>
void warnOnce(const ros::MessageEvent<const Message>& event, const std::string& trait) {
  warnOnce(topicOf(event.getConnectionHeaderPtr()), event.getPublisherName(), trait);
}

// Whether the map that came has no cells, as octomap_server's before it has seen anything: the one before stays. Warns of it.
bool isNotYet(const MapEvent& event);
// Warns of what a map that is taken has of such things: an origin without an orientation, as octomap_server's; the inflation of
// costmap_2d.
void tellTraits(const MapEvent& event);

// Says where the thresholds of occupancy do not fit the maps that come (grid/foreign_values.h). Of one thread.
class MapFit {
 public:
  // Why they do not, logged where that is another sentence than before; empty where they do, or there is no map.
  std::string problem(const std::shared_ptr<const grid::OccupancyGrid>& map,
                      const grid::OccupancyThresholds& thresholds);

 private:
  grid::ThresholdFit fit_;
  std::string told_;
};

}  // namespace grid_path_planner::nodes
