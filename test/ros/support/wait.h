// Waiting in rostests: for a condition, up to a deadline that only a failure reaches.
#pragma once

#include <algorithm>
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

// Whether `condition` came true before the deadline, asked every 5 ms of the steady clock. A session may be left
// without any processor for seconds: of a pause between two questions half a second counts, and the last
// question comes after the deadline.
inline bool waitFor(const std::function<bool()>& condition,
                    std::chrono::duration<double> deadline = kDeadline) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::duration<double> most(0.5);
  std::chrono::duration<double> passed(0.0);
  for (auto asked = Clock::now(); !condition();) {
    if (passed > deadline) return false;
    const auto answered = Clock::now();
    passed += answered - asked;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    asked = Clock::now();
    passed += std::min<std::chrono::duration<double>>(asked - answered, most);
  }
  return true;
}

}  // namespace grid_path_planner::test
