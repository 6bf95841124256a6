// In which order the whole maps and updates of a publisher belong together:
// they have connections of their own, and come in any order. Stamps and numbers
// tell it, but nothing after a stamp of 0, and nothing across a jump of ROS
// time.
//
//   if (order.note(publisher, update->header.seq) > 0) askForAWholeMap();
//   if (order.isAwaited(publisher)) return order.keep(publisher, update);  // until its map is there
//   if (!order.isOld(*update)) order.tookUpdate(*update);
//
//   const MapOrder::Whole whole = order.judge(publisher, map.header.stamp, asked_at);
//   take(withUpdates(map, whole.newer));
//   order.tookWhole(whole);
//
// Not thread-safe.
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <ros/time.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "ros/input/recent_updates.h"
#include "ros/input/update_sequence.h"

namespace grid_path_planner::nodes {

class MapOrder {
 public:
  using Clock = std::chrono::steady_clock;

  // What is known of a whole map that has come.
  struct Whole {
    std::string publisher;
    ros::Time stamp;
    std::vector<RecentUpdates::Update> newer;  // that belong upon it
    bool lacks = false;      // updates that were sent before it came, and are not kept
    bool has_lost = false;   // it was sent before what was lost
    bool is_before = false;  // another one is awaited
  };

  // Stamps and announcements of before say nothing of what comes now.
  void timeWentBack();

  // An update or heartbeat with this number has come. How many before it were
  // lost.
  std::uint32_t note(const std::string& publisher, std::uint32_t number);
  void noteAnnouncement(const std::string& publisher, const ros::Time& stamp);
  // What came by now, stamped up to `stamp`, may lack something.
  void noteLoss(const ros::Time& stamp = {});

  // Whether it was announced that `publisher` sends a map of another place or
  // size, which has not come.
  bool isAwaited(const std::string& publisher) const;
  // Since when; none where no map is.
  std::optional<Clock::time_point> awaitedSince() const;

  // Whether the map that is there was sent after the update, and holds it.
  bool isOld(const map_msgs::OccupancyGridUpdate& update) const;
  // For a whole map that was sent before it and comes after it.
  void keep(const std::string& publisher, const RecentUpdates::Update& update);
  void tookUpdate(const map_msgs::OccupancyGridUpdate& update);

  // `asked_at`: when a whole map was asked for last.
  Whole judge(const std::string& publisher, const ros::Time& stamp,
              Clock::time_point asked_at) const;
  void tookWhole(const Whole& whole);

 private:
  struct Announced {
    std::string publisher;
    ros::Time stamp;
    Clock::time_point came;
  };

  UpdateSequence sequence_;  // of the subscribers, as the next
  RecentUpdates recent_;
  std::optional<Announced> announced_;  // a map that has not come
  std::string publisher_;               // of the last whole map; empty before the first
  ros::Time whole_stamp_;               // its stamp
  bool whole_came_last_ = false;        // after the last update of its publisher
  ros::Time newest_;                    // stamp of the newest message in the map
  ros::Time lost_at_;                   // a whole map from before that lacks what was lost, too
};

}  // namespace grid_path_planner::nodes
