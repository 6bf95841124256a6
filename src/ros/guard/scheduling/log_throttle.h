// Lines of a log that would come too often, from any thread.
//
//   static LogThrottle seldom(5.0);
//   ROS_WARN_COND(seldom.isDue(), "The camera is late");
//
// roscpp's ROS_WARN_THROTTLE keeps the time of its last line where no lock and no atomic guards it, for all threads in which
// the nodelets of a manager run; and it counts ROS time, of which there may be none.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>

namespace grid_path_planner::nodes {

class LogThrottle {
 public:
  // At most one line in `period` (s, steady clock).
  explicit constexpr LogThrottle(double period)
      : period_(static_cast<std::int64_t>(period * 1e9)) {}

  // True for one caller, however many ask at once: no other line is due for a period.
  bool isDue() {
    const auto now = std::chrono::duration_cast<std::chrono::nanoseconds>(
                         std::chrono::steady_clock::now().time_since_epoch())
                         .count();
    std::int64_t next = next_.load();
    return now >= next && next_.compare_exchange_strong(next, now + period_);
  }

 private:
  const std::int64_t period_;  // ns
  std::atomic<std::int64_t> next_{std::numeric_limits<std::int64_t>::min()};
};

}  // namespace grid_path_planner::nodes
