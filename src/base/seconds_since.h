// Time by the steady clock, which no /clock and nobody who sets the system's changes.
#pragma once

#include <chrono>

namespace grid_path_planner::base {

inline double secondsSince(std::chrono::steady_clock::time_point time) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
}

}  // namespace grid_path_planner::base
