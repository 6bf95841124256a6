#include "ros/guard/clock.h"

#include <ros/console.h>

#include <chrono>
#include <cstdint>
#include <thread>

#include "ros/guard/scheduling/log_throttle.h"

namespace grid_path_planner::nodes {

using base::Stopped;
using base::StopReason;
using base::StopToken;

double secondsBetween(const ros::Time& from, const ros::Time& to) {
  const auto seconds = [](std::uint32_t count) { return static_cast<double>(count); };
  return seconds(to.sec) - seconds(from.sec) + 1e-9 * (seconds(to.nsec) - seconds(from.nsec));
}

ros::Time normalized(const ros::Time& time) {
  constexpr std::uint32_t kSecond = 1'000'000'000;
  const std::uint64_t seconds = std::uint64_t{time.sec} + time.nsec / kSecond;
  if (seconds > ros::TIME_MAX.sec) return ros::TIME_MAX;
  return {static_cast<std::uint32_t>(seconds), time.nsec % kSecond};
}

bool hasTime() {
  if (ros::Time::isValid()) return true;
  static LogThrottle seldom(5.0);
  ROS_WARN_COND(seldom.isDue(), "use_sim_time is set and no /clock has come yet: waiting for it");
  return false;
}

void waitForClock(const StopToken& stop) {
  while (!hasTime()) {
    if (stop.reason() != StopReason::NONE) throw Stopped(stop.reason());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace grid_path_planner::nodes
