// ROS time that has not come yet, that jumps back, and that comes after the messages of its instant.
#pragma once

#include <ros/time.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "grid_path_planner/base/stop_token.h"

namespace grid_path_planner::nodes {

// Thread-safe.
class ClockWatch {
 public:
  // Whether there is a ROS time. With use_sim_time and no /clock yet there is none, every stamp
  // would be 0, and every 5 s a warning says so.
  bool hasTime();

  // By how many seconds ROS time is before that of an earlier call, as when a bag loops; none where it
  // is not. Reported once for each jump.
  std::optional<double> jumpedBack();

 private:
  std::mutex mutex_;
  ros::Time latest_;
  std::chrono::steady_clock::time_point next_warning_{};
};

// With /clock ROS time comes by a topic of its own, and messages overtake it, the farther the faster a
// bag is played. Not thread-safe.
class LateClock {
 public:
  // ROS time. With /clock, where `stamp` is more than `ahead` (s) after it, it is waited for: 50 ms of
  // wall clock at most, and not for a second after that was in vain, as for a stamp that is wrong.
  ros::Time timeFor(const ros::Time& stamp, double ahead);

 private:
  std::chrono::steady_clock::time_point next_wait_{};
};

// s, that clocks of nodes may differ by: two machines, and two nodes at many times real time of which one has waited for a
// processor.
constexpr double kMostAhead = 10.0;

// From `from` to `to` in seconds. roscpp's difference of times throws beyond 2^31 s, as a stamp from
// 2106 or, from 2038 on, one of 0 has it.
double secondsBetween(const ros::Time& from, const ros::Time& to);

// The same time with less than 10^9 ns, which a message or /clock may have more of; the last that there is where that is
// beyond it. roscpp throws there, or compares what cannot be compared.
ros::Time normalized(const ros::Time& time);

// Why a message stamped `stamp` is of another time, to be told after "A path stamped 7.0 is not driven": it is from
// before `owner` started, at `started`, or ahead by more than clocks of nodes may differ, as what a publisher that
// latches sends again after ROS time went back. Empty: it is of this time.
std::string whyOfAnotherTime(const ros::Time& stamp, const ros::Time& started,
                             const std::string& owner);

// Waits until there is a ROS time. Throws Stopped.
void waitForClock(const base::StopToken& stop);

}  // namespace grid_path_planner::nodes
