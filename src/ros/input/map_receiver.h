// Receives the map: whole on `projected_map`, in pieces on `projected_map_updates`, or on another topic and its
// updates.
//
// A whole map that lies where the one before did costs one comparison with it, and what differs is
// taken as a piece is.
//
// An invalid message is refused with an error that says why, and the map before it stays; so is a
// piece outside the map. A piece older than the map is dropped: it is part of the map already. One that is stamped 0, as
// costmap_2d's are, counts in the order in which it comes (map_order.h). Maps handed out never change; a piece makes a new one
// in time proportional to the piece (grid/double_buffered.h).
//
// A piece without cells (0x0) is a heartbeat: it changes nothing and is accepted before there is a
// map; only its stamp, who sent it and when it came are kept.
//
// Updates that follow the announcement of a map of another place or size (messages/map_announcement.h) wait for that map, or
// for the next one after it was asked for. Announcements count of the map's own publisher only.
//
// Of updates that come faster than they are applied at most 64 MB wait; the oldest are lost first.
//
// An update that is lost is noticed by the numbers of those that come (update_sequence.h), also of heartbeats. Then a whole map
// is asked for (whole_map_subscription.h). Until it is there, lost() says so and the updates that come are applied. A map that
// was announced and has not come for 2 s is lost, too.
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <ros/subscriber.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "grid_path_planner/grid/double_buffered.h"
#include "grid_path_planner/grid/occupancy.h"
#include "ros/guard/incoming/bounded_subscription.h"
#include "ros/guard/node_time.h"
#include "ros/input/map_data.h"
#include "ros/input/map_order.h"
#include "ros/input/whole_map_subscription.h"

namespace grid_path_planner::nodes {

struct ReceivedMap {
  std::shared_ptr<const grid::OccupancyGrid> grid;
  std::string frame_id;                              // empty where the message named none
  ros::Time stamp;                                   // of the newest message in it
  std::string publisher;                             // the node that sent it whole
  std::string sender;                                // of the newest message in it: a node
  std::chrono::steady_clock::time_point received{};  // that message
  MapData data;                                      // by what `publisher` says
};

struct MapChange {
  ReceivedMap map;
  // The cells that may differ from those of the map before, disjoint; nullopt: all may.
  std::optional<std::vector<grid::CellRect>> changed;
};

struct MapHeartbeat {
  ros::Time stamp;  // of the newest cloud in the publisher's map, 0: none; any number may come
  std::chrono::steady_clock::time_point received;
  std::string publisher;  // the node
};

// The cells of `map` that `update` replaces. Throws InputError for an update that does not lie in
// the map, whose number of values is not width x height, or with a value outside -1..100.
grid::CellRect checkedRect(const grid::OccupancyGrid& map,
                           const map_msgs::OccupancyGridUpdate& update);

// Replaces them. Precondition: `rect` is checkedRect(map, update).
void applyUpdate(const map_msgs::OccupancyGridUpdate& update, const grid::CellRect& rect,
                 grid::OccupancyGrid& map);

// How long a map may lack changes that were lost: a whole one is asked for at once.
constexpr double kLostTimeout = 1.0;  // s

class MapReceiver {
 public:
  using OnChange = std::function<void(const MapChange&)>;

  // Subscribes. `on_change` is called after every change, `on_heartbeat` after every heartbeat, in
  // the subscriber's thread.
  void start(
      ros::NodeHandle nh, OnChange on_change, std::function<void()> on_heartbeat = [] {},
      const std::string& topic = "projected_map");

  // The resolved name of the topic of maps; empty before start().
  std::string topic() const;

  // The newest map; its grid is null before the first.
  ReceivedMap latest() const;
  // The newest one; none before the first.
  std::optional<MapHeartbeat> heartbeat() const;
  // Why the last message was refused; empty after one that was accepted.
  std::string refusal() const;

  // Why the map may lack changes, in a sentence; empty where it does not.
  std::string lost() const;
  // Since when; none where it does not.
  std::optional<std::chrono::steady_clock::time_point> lostSince() const;
  // The same in a sentence, once that is longer than a map may lack changes: for whoever hands the map on, of whose own
  // updates none was lost.
  std::string whyIncomplete() const;

  void shutdown();

 private:
  using UpdateEvent = ros::MessageEvent<map_msgs::OccupancyGridUpdate const>;
  using Clock = std::chrono::steady_clock;

  void onMap(const MapEvent& event);
  void onUpdate(const UpdateEvent& event);
  void onHeartbeat(const UpdateEvent& event);
  MapChange use(const MapEvent& event, const MapOrder::Whole& whole);
  // Makes the grid of `message` the present one. What changed; nullopt where it lies elsewhere.
  std::optional<std::vector<grid::CellRect>> takeGrid(const nav_msgs::OccupancyGrid& message,
                                                      const std::string& frame_id);
  void noteUpdate(const UpdateEvent& event);
  MapChange apply(const UpdateEvent& event);
  void noteLoss(const std::string& what);
  void noteComplete();
  // To the listener: the whole map where an earlier change was not told.
  void tell(MapChange change, bool whole);
  // By a timer: asks for the map again where it lacks something, and for the subscription.
  void retry();
  // The map whose grid is the present one of grids_.
  MapChange store(ReceivedMap map, std::optional<std::vector<grid::CellRect>> changed);
  void refuse(const std::string& topic, const std::string& reason);

  OnChange on_change_;
  std::function<void()> on_heartbeat_;
  // The subscribers' thread's:
  grid::DoubleBuffered<grid::OccupancyGrid> grids_;
  MapOrder order_;
  bool torn_ = false;  // an error ended a change of the map before the listener knew of it

  mutable std::mutex mutex_;  // of what follows up to the subscriptions
  std::string topic_;         // resolved
  ReceivedMap map_;
  std::string refusal_;
  std::optional<MapHeartbeat> heartbeat_;
  std::string lost_;
  Clock::time_point lost_since_;

  WholeMapSubscription maps_;
  ros::Subscriber updates_;
  ros::SteadyTimer retry_timer_;
  std::shared_ptr<void> on_jump_back_;
};

}  // namespace grid_path_planner::nodes
