// ROS time that is not there yet, and ROS time that jumps back.
#pragma once

#include <ros/time.h>

#include <mutex>

#include "grid_path_planner/base/stop_token.h"

namespace grid_path_planner::nodes {

// With use_sim_time and no /clock yet every stamp would be 0: waits until there is one, with a
// warning every 5 s. Throws Stopped.
void waitForClock(const base::StopToken& stop);

// Notices that ROS time went back, as when a bag loops. Thread-safe.
class ClockWatch {
 public:
  // Whether ROS time is before that of an earlier call; once for each jump.
  bool jumpedBack();

 private:
  std::mutex mutex_;
  ros::Time latest_;
};

}  // namespace grid_path_planner::nodes
