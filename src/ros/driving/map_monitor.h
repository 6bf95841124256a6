// Receives the map and watches whether its publisher lives: by its heartbeats, and by its answers where it has sent none
// (publisher_watch.h).
//
//   MapMonitor watch(nh, [&](const MapLiveness& life) { use(life); });
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "ros/driving/map_liveness.h"
#include "ros/driving/publisher_watch.h"
#include "ros/input/foreign_rules.h"
#include "ros/input/map_receiver.h"

namespace grid_path_planner::nodes {

class MapMonitor {
 public:
  using Listener = std::function<void(const MapLiveness&)>;

  // `listener` is called with every sign of life, in the thread of `nh` or in one of this.
  MapMonitor(const ros::NodeHandle& nh, Listener listener);
  ~MapMonitor();

  MapLiveness life() const;
  // As MapFit::problem() of the newest map. Of one thread.
  std::string misfit(const grid::OccupancyThresholds& thresholds) {
    return map_fit_.problem(life().map.grid, thresholds);
  }

 private:
  void onMap();
  void noteLoss();  // under the lock
  void onHeartbeat();
  void tell();
  std::string whom() const;
  void onAnswer(const std::string& node);

  const Listener listener_;
  std::mutex telling_;  // so that no older life is told after a newer one
  MapReceiver receiver_;
  MapFit map_fit_;

  mutable std::mutex mutex_;
  MapLiveness life_;
  std::unique_ptr<PublisherWatch> publisher_;
};

}  // namespace grid_path_planner::nodes
