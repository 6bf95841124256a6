// Whether the map that a vehicle is driven by is there, and still kept up.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "base/seconds_since.h"
#include "ros/input/map_receiver.h"

namespace grid_path_planner::nodes {

// How long a publisher without heartbeats may be deaf.
constexpr double kPublisherTimeout = 5.0;  // s

struct MapLife {
  std::string topic;       // resolved
  ReceivedMap map;         // its grid is null before the first
  bool heartbeat = false;  // whether the publisher of the map sends heartbeats
  ros::Time newest;        // measurement in the map, or the map's own stamp
  // The last map, piece, heartbeat or, without heartbeats, answer of the publisher; pieces of others are none.
  std::chrono::steady_clock::time_point sign;
  std::string lost;  // why the map lacks changes; empty where it does not
  std::optional<std::chrono::steady_clock::time_point> lost_since;

  double silence() const { return base::secondsSince(sign); }
};

// Why the vehicle must not be driven by it, in a sentence; empty where it may.
std::string whyNoMap(const MapLife& life, double map_timeout);

}  // namespace grid_path_planner::nodes
