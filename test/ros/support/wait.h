// Waiting in rostests: for a condition, up to a deadline that only a failure reaches.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace grid_path_planner::test {

// Sanitizers make nodes some ten times slower.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kSlowdown = 4;
#else
constexpr int kSlowdown = 1;
#endif

constexpr std::chrono::seconds kDeadline(20 * kSlowdown);

// Whether `condition` came true before the deadline, asked every 5 ms of the steady clock.
inline bool waitFor(const std::function<bool()>& condition,
                    std::chrono::duration<double> deadline = kDeadline) {
  const auto end = std::chrono::steady_clock::now() + deadline;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace grid_path_planner::test
