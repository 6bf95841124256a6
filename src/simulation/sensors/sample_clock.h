// When a sensor measures: at the first step of the simulation at or after each whole multiple of its
// period.
#pragma once

#include <cmath>
#include <cstdint>

namespace grid_path_planner::simulation {

class SampleClock {
 public:
  explicit SampleClock(double rate) : period_ns_(std::llround(1e9 / rate)) {}

  // Whether a sample is due at this time, which never decreases; it is taken then.
  bool take(std::int64_t time_ns) {
    if (time_ns < next_ns_) return false;
    next_ns_ = (time_ns / period_ns_ + 1) * period_ns_;
    return true;
  }

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
};

}  // namespace grid_path_planner::simulation
