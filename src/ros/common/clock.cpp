#include "ros/common/clock.h"

#include <ros/console.h>

#include <chrono>
#include <thread>

namespace grid_path_planner::nodes {

using base::Stopped;
using base::StopReason;
using base::StopToken;

void waitForClock(const StopToken& stop) {
  auto next_warning = std::chrono::steady_clock::now();
  while (!ros::Time::isValid()) {
    if (stop.reason() != StopReason::NONE) throw Stopped(stop.reason());
    if (std::chrono::steady_clock::now() >= next_warning) {
      ROS_WARN("use_sim_time is set and no /clock has come yet: waiting for it");
      next_warning += std::chrono::seconds(5);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

bool ClockWatch::jumpedBack() {
  const ros::Time now = ros::Time::now();
  std::lock_guard<std::mutex> lock(mutex_);
  const bool back = now < latest_;
  latest_ = now;
  return back;
}

}  // namespace grid_path_planner::nodes
