// ROS time that has not come yet, and ROS time that jumps back.
#pragma once

#include <ros/time.h>

#include <chrono>
#include <mutex>
#include <optional>

#include "grid_path_planner/base/stop_token.h"

namespace grid_path_planner::nodes {

// Thread-safe.
class ClockWatch {
 public:
  // Whether there is a ROS time. With use_sim_time and no /clock yet there is none, every stamp
  // would be 0, and every 5 s a warning says so.
  bool hasTime();

  // By how many seconds `now` is before that of an earlier call, as when a bag loops; none where it
  // is not. Reported once for each jump.
  std::optional<double> jumpedBack(const ros::Time& now = ros::Time::now());

 private:
  std::mutex mutex_;
  ros::Time latest_;
  std::chrono::steady_clock::time_point next_warning_{};
};

// From `from` to `to` in seconds. roscpp's difference of times throws beyond 2^31 s, as a stamp from
// 2106 or, from 2038 on, one of 0 has it.
double secondsBetween(const ros::Time& from, const ros::Time& to);

// Waits until there is a ROS time. Throws Stopped.
void waitForClock(const base::StopToken& stop);

}  // namespace grid_path_planner::nodes
