// Whether the map that a vehicle is driven by is there, and still kept up.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>

#include "base/seconds_since.h"
#include "ros/guard/clock.h"
#include "ros/input/map_receiver.h"

namespace grid_path_planner::nodes {

// How long a publisher without heartbeats may be deaf.
constexpr double kPublisherTimeout = 5.0;  // s

// With one decimal: the text changes from tick to tick.
std::string silenceText(double seconds);

// For how long a vehicle was commanded to move, by ROS time.
class DrivenTime {
 public:
  // Such a command is sent.
  void note(const ros::Time& now) {
    seconds_ += std::clamp(secondsBetween(last_, now), 0.0, kLongestTick);
    last_ = now;
  }
  double seconds() const { return seconds_; }

 private:
  static constexpr double kLongestTick = 0.2;  // s, between two commands of one drive

  ros::Time last_;
  double seconds_ = 0.0;
};

struct MapLiveness {
  std::string topic;  // resolved
  ReceivedMap map;    // its grid is null before the first
  // Whether its publisher offers it by the service static_map, as map_server and map_publisher do: no other one is expected.
  // None: it is not known.
  std::optional<bool> of_file;
  DrivenTime driven;  // since map.data.changes() changed
  // The last map, piece, heartbeat or, without heartbeats, answer of the publisher; pieces of others are none.
  std::chrono::steady_clock::time_point last_heard;
  std::string lost;  // why the map lacks changes; empty where it does not
  std::optional<std::chrono::steady_clock::time_point> lost_since;

  double silence() const { return base::secondsSince(last_heard); }
};

struct MapTimeouts {
  double heartbeat, data;  // s
};

// Why the vehicle must not be driven by it, in a sentence; empty where it may.
std::string whyNoMap(const MapLiveness& life, const MapTimeouts& timeouts);

}  // namespace grid_path_planner::nodes
