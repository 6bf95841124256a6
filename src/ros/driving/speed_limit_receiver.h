// Receives the map of speed limits: nav_msgs/OccupancyGrid on `speed_limit`, 0 no limit, 1 to 100 percent of max_speed.
//
//   SpeedLimitReceiver receiver(nh, [&](const SpeedLimits& limits) { loop.setSpeedLimits(limits); });
//
// A message that is no map is refused with an error, and the map before it stays. A map holds as long as the node that sent
// it answers: it may be latched for good, and nobody knows what the limits are where that node is dead.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "grid_path_planner/grid/occupancy.h"
#include "ros/driving/publisher_watch.h"
#include "ros/input/foreign_rules.h"

namespace grid_path_planner::nodes {

struct SpeedLimits {
  std::shared_ptr<const grid::OccupancyGrid> grid;  // null before the first map
  std::string frame_id;
  std::string topic, publisher;
  std::chrono::steady_clock::time_point
      last_heard;  // of life of the publisher: the map, or an answer
};

// Why the vehicle must not be driven by them, in a sentence; empty where it may, as without a map.
std::string whyNoLimits(const SpeedLimits& limits);

class SpeedLimitReceiver {
 public:
  using Listener = std::function<void(const SpeedLimits&)>;

  // `listener` is called for every map that can be used, in the thread of `nh`, and for every answer of its publisher, in
  // one of this.
  SpeedLimitReceiver(ros::NodeHandle nh, Listener listener);
  ~SpeedLimitReceiver();

  // In words, for diagnostics.
  const std::string& state() const { return state_; }

 private:
  void onMap(const MapEvent& event);
  void use(SpeedLimits limits);
  std::string publisher() const;
  void onAnswer(const std::string& node);

  const Listener listener_;
  std::string state_ = "no map of speed limits has come";
  mutable std::mutex mutex_;  // of what follows, while the listener is called too
  SpeedLimits limits_;
  ros::Subscriber subscriber_;
  PublisherWatch watch_{
      {[this] { return publisher(); }, [this](const std::string& node) { onAnswer(node); }}};
};

}  // namespace grid_path_planner::nodes
