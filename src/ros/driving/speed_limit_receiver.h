// Receives the map of speed limits: nav_msgs/OccupancyGrid on `speed_limit`, 0 no limit, 1 to 100 percent of max_speed.
//
//   SpeedLimitReceiver receiver(nh, [&](const SpeedLimits& limits) { loop.setSpeedLimits(limits); });
//
// A message that is no map is refused with an error, and the map before it stays.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <functional>
#include <memory>
#include <string>

#include "grid_path_planner/grid/occupancy.h"
#include "ros/input/foreign_rules.h"

namespace grid_path_planner::nodes {

struct SpeedLimits {
  std::shared_ptr<const grid::OccupancyGrid> grid;  // null before the first map
  std::string frame_id;
};

class SpeedLimitReceiver {
 public:
  using Listener = std::function<void(const SpeedLimits&)>;

  // `listener` is called for every map that can be used, in the thread of `nh`.
  SpeedLimitReceiver(ros::NodeHandle nh, Listener listener);

  // In words, for diagnostics.
  const std::string& state() const { return state_; }

 private:
  void onMap(const MapEvent& event);

  const Listener listener_;
  std::string state_ = "no map of speed limits has come";
  ros::Subscriber subscriber_;
};

}  // namespace grid_path_planner::nodes
