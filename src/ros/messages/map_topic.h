// A topic of whole maps and, as <topic>_updates, of what changes in them: what a publisher of both
// must know to send each subscriber what it can use, and no more.
//
// The owner asks: hasSubscribers(), without whom nothing need be made and forget() drops what is
// latched; takeNewSubscriber(), needsWholeMaps() and wholeMapIsDue(), any of which asks for a whole
// map; else an update will do.
//
// A whole map of another place or size than the one before is announced to those who take the updates (map_announcement.h).
//
// Maps and updates are stamped with the newest measurement in them, by which whoever hands them on tells how old they are
// (stampFor()); their order can be told by it too.
//
// One thread sends; the callbacks come in that of the node's queue. Subscribers are told apart by
// the names of their nodes, so nodelets of one manager count as one.
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <chrono>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "grid_path_planner/grid/occupancy.h"

namespace grid_path_planner::nodes {

// An update of a rectangle whose values are still to come, row by row.
map_msgs::OccupancyGridUpdate updateOf(const grid::CellRect& cells, const std::string& frame_id,
                                       const ros::Time& stamp);
// With those that `map`, in which the rectangle lies, has there.
map_msgs::OccupancyGridUpdate updateOf(const grid::OccupancyGrid& map, const grid::CellRect& cells,
                                       const std::string& frame_id, const ros::Time& stamp);

// The rectangles of the updates for what changed: so few that none is lost which wait for a subscriber at once.
std::vector<grid::CellRect> updateRects(const std::vector<grid::CellRect>& changed);

class MapTopic {
 public:
  // `on_subscriber` is called for a new subscriber of either topic.
  MapTopic(ros::NodeHandle nh, const std::string& topic, bool latch,
           std::function<void()> on_subscriber);

  bool hasSubscribers() const;
  // Whether one came since the last call.
  bool takeNewSubscriber();
  // Whether a subscriber of the maps does not take the updates.
  bool needsWholeMaps() const;
  // Whether updates were sent since the last whole map, and that was so many seconds ago.
  bool wholeMapIsDue(double period) const;

  // Of what is sent next and holds measurements up to `newest`, as far as they are not later than `now`; 0: none, then `now`.
  // Later than what was stamped before, by 1 ns where nothing newer is in it, unless ROS time went back.
  ros::Time stampFor(const ros::Time& newest, const ros::Time& now);

  void send(const nav_msgs::OccupancyGrid& map);
  void send(const map_msgs::OccupancyGridUpdate& update);
  // An update of no cells, after which no whole map is due.
  void sendHeartbeat(const map_msgs::OccupancyGridUpdate& heartbeat) {
    updates_.publish(heartbeat);
  }
  // The map that was sent last is not latched any longer: it is out of date, and nobody listens.
  void forget();

 private:
  using Subscribers = std::multiset<std::string>;

  // Where it lies, and its size: the map without its cells.
  static nav_msgs::OccupancyGrid placeOf(const nav_msgs::OccupancyGrid& map);
  ros::SubscriberStatusCallback adding(Subscribers& to);
  ros::SubscriberStatusCallback removing(Subscribers& from);

  const std::function<void()> on_subscriber_;
  mutable std::mutex mutex_;  // of what follows up to the publishers
  Subscribers of_maps_;       // names of their nodes
  Subscribers of_updates_;
  bool new_subscriber_ = false;
  bool updated_ = false;  // since the last whole map
  std::chrono::steady_clock::time_point sent_at_;
  ros::Time stamp_;                // the last of stampFor()
  nav_msgs::OccupancyGrid place_;  // of the map that was sent last, without its cells
  ros::Publisher maps_;
  ros::Publisher updates_;
};

}  // namespace grid_path_planner::nodes
